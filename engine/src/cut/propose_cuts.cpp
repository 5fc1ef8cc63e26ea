// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>

#include "cut/topology.h"
#include "cut/tube_symmetry.h"
#include "toile/curve/geodesic.h"
#include "toile/cut/on_model.h"

namespace toile {
namespace {

/// The shortest way along mesh edges from the sources to the targets; empty if there is none.
std::vector<VertexId> shortestEdgePath(const Mesh& mesh, const std::vector<VertexId>& sources,
                                       const std::vector<bool>& isTarget) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  using Entry = std::pair<double, VertexId>;
  VertexData<double> distance(mesh.vertexCount(), kFar);
  VertexData<VertexId> before(mesh.vertexCount());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const VertexId v : sources) {
    distance[v] = 0;
    open.emplace(0.0, v);
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    if (isTarget[v.index()]) {
      std::vector<VertexId> path{v};
      while (before[path.back()].isValid()) path.push_back(before[path.back()]);
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (const FaceId f : mesh.facesAround(v)) {
      for (const VertexId next : mesh.vertices(f)) {
        if (next == v) continue;
        const double reached = d + (mesh.position(next) - mesh.position(v)).norm();
        if (reached < distance[next]) {
          distance[next] = reached;
          before[next] = v;
          open.emplace(reached, next);
        }
      }
    }
  }
  return {};
}

using End = cutting::TubeEnd;

/// The locally shortest way between two ends, found from a way along edges: straightened within the
/// opened piece, so that it crosses none of its seams, its tips moved along the ends while that
/// makes it shorter.
Result<SurfacePath> shortestLink(GeodesicLinker& linker, const Mesh& mesh,
                                 const std::array<const End*, 2>& ends,
                                 const std::vector<VertexId>& edgePath) {
  std::array<VertexId, 2> tips{edgePath.front(), edgePath.back()};
  Result<SurfacePath> best = linker.link({tips[0]}, {tips[1]});
  if (!best) return best;
  double shortest = length(mesh, *best);
  std::size_t stepsLeft = ends[0]->size() + ends[1]->size();
  for (bool changed = true; changed && stepsLeft > 0;) {
    changed = false;
    for (std::size_t tip = 0; tip < 2; ++tip) {
      const End& end = *ends[tip];
      const auto at =
          static_cast<std::size_t>(std::find(end.begin(), end.end(), tips[tip]) - end.begin());
      for (const std::size_t step : {std::size_t{1}, end.size() - 1}) {
        std::array<VertexId, 2> moved = tips;
        moved[tip] = end[(at + step) % end.size()];
        Result<SurfacePath> link = linker.link({moved[0]}, {moved[1]});
        if (!link) continue;
        const double reached = length(mesh, *link);
        if (reached >= shortest * (1 - 1e-9)) continue;
        tips = moved;
        shortest = reached;
        best = std::move(link);
        changed = true;
        --stepsLeft;
        break;
      }
      if (stepsLeft == 0) break;
    }
  }
  return best;
}

/// A tube within this share of its size of its mirror image is cut open symmetrically.
constexpr double kSymmetric = 0.02;

/// Cuts of a symmetric tube that are symmetric too: ends in the middle are joined along the middle,
/// the others in pairs.
class SymmetricCuts {
 public:
  SymmetricCuts(const std::shared_ptr<const Mesh>& mesh, const std::vector<End>& ends,
                cutting::TubeSymmetry plane)
      : mesh_(*mesh), ends_(ends), plane_(std::move(plane)), linker_(mesh) {}

  /// @return nothing where the shortest ways are not symmetric.
  std::optional<std::vector<SurfacePath>> run() {
    std::vector<std::size_t> joined, left;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      (isMiddle(i) && joined.empty() ? joined : left).push_back(i);
    }
    std::vector<SurfacePath> cuts;
    while (!left.empty()) {
      std::vector<SurfacePath> shortest;
      std::size_t next = 0;
      for (const std::size_t i : left) {
        std::vector<SurfacePath> links =
            isMiddle(i) ? middleLink(joined, i) : pairOfLinks(joined, i);
        if (links.empty() || (!shortest.empty() &&
                              length(mesh_, links.front()) >= length(mesh_, shortest.front()))) {
          continue;
        }
        shortest = std::move(links);
        next = i;
      }
      if (shortest.empty()) return std::nullopt;
      for (const std::size_t i : {next, plane_.imageOf[next]}) {
        if (std::erase(left, i) > 0) joined.push_back(i);
      }
      cuts.insert(cuts.end(), shortest.begin(), shortest.end());
    }
    return cuts;
  }

 private:
  [[nodiscard]] bool isMiddle(std::size_t end) const {
    return plane_.imageOf[end] == end && !plane_.middleOf(mesh_, ends_[end]).empty();
  }

  /// The shortest link in the mirror plane.
  std::vector<SurfacePath> middleLink(const std::vector<std::size_t>& joined, std::size_t end) {
    std::vector<SurfacePath> best;
    for (const std::size_t from : joined) {
      if (!isMiddle(from)) continue;
      for (const VertexId a : plane_.middleOf(mesh_, ends_[from])) {
        for (const VertexId b : plane_.middleOf(mesh_, ends_[end])) {
          Result<SurfacePath> link = linker_.link({a}, {b});
          if (!link || !staysInMiddle(*link)) continue;
          if (best.empty() || length(mesh_, *link) < length(mesh_, best.front())) {
            best = {*std::move(link)};
          }
        }
      }
    }
    return best;
  }

  /// The shortest link on one side and its mirror image.
  std::vector<SurfacePath> pairOfLinks(const std::vector<std::size_t>& joined, std::size_t end) {
    std::vector<VertexId> sources;
    for (const std::size_t i : joined) {
      sources.insert(sources.end(), ends_[i].begin(), ends_[i].end());
    }
    std::vector<bool> isTarget(mesh_.vertexCount(), false);
    for (const VertexId v : ends_[end]) isTarget[v.index()] = true;
    const std::vector<VertexId> path = shortestEdgePath(mesh_, sources, isTarget);
    if (path.empty()) return {};
    const std::size_t from = *std::find_if(joined.begin(), joined.end(), [&](std::size_t i) {
      return std::find(ends_[i].begin(), ends_[i].end(), path.front()) != ends_[i].end();
    });
    Result<SurfacePath> link = shortestLink(linker_, mesh_, {&ends_[from], &ends_[end]}, path);
    if (!link || !staysOnOneSide(*link)) return {};
    Result<SurfacePath> image = linker_.link({imageIn(ends_[plane_.imageOf[from]], *link, true)},
                                             {imageIn(ends_[plane_.imageOf[end]], *link, false)});
    if (!image || !staysOnOneSide(*image)) return {};
    return {*std::move(link), *std::move(image)};
  }

  [[nodiscard]] double heightOf(const SurfacePoint& point) const {
    return plane_.height(position(mesh_, point));
  }
  [[nodiscard]] bool staysInMiddle(const SurfacePath& path) const {
    return std::all_of(path.points.begin(), path.points.end(), [&](const SurfacePoint& p) {
      return std::abs(heightOf(p)) <= plane_.tolerance;
    });
  }
  [[nodiscard]] bool staysOnOneSide(const SurfacePath& path) const {
    const bool isAbove = heightOf(path.points.back()) > 0;
    return std::all_of(path.points.begin(), path.points.end(), [&](const SurfacePoint& p) {
      return isAbove ? heightOf(p) > 0 : heightOf(p) < 0;
    });
  }
  /// The vertex of an end nearest to the mirror image of one of the path's tips.
  [[nodiscard]] VertexId imageIn(const End& end, const SurfacePath& path, bool atStart) const {
    const Eigen::Vector3d image =
        plane_.image(position(mesh_, atStart ? path.points.front() : path.points.back()));
    return *std::min_element(end.begin(), end.end(), [&](VertexId a, VertexId b) {
      return (mesh_.position(a) - image).norm() < (mesh_.position(b) - image).norm();
    });
  }

  const Mesh& mesh_;
  const std::vector<End>& ends_;
  cutting::TubeSymmetry plane_;
  GeodesicLinker linker_;
};

/// Links of the open ends of a tube, one fewer than there are ends.
std::vector<SurfacePath> symmetricCuts(const Piece& piece, const std::vector<End>& ends) {
  auto plane = cutting::findTubeSymmetry(piece.mesh, ends, kSymmetric);
  if (!plane) return {};
  return SymmetricCuts(piece.mesh, ends, *std::move(plane))
      .run()
      .value_or(std::vector<SurfacePath>());
}

}  // namespace

Result<std::vector<StylingCurve>> proposeCuts(const Piece& piece, const ReferenceModel& model) {
  std::vector<StylingCurve> cuts;
  const PieceTopology shape = topology(piece);
  if (shape.canLieFlat()) return cuts;
  const auto refuse = [&](const char* why) {
    return Error{ErrorCode::NotADisk,
                 fmt::format("piece \"{}\" {}: no cut can be proposed, draw seams that divide it",
                             piece.id, why),
                 {Element::piece(piece.id)}};
  };
  if (shape.boundaryLoops == 0) return refuse("is a closed surface");
  if (shape.eulerCharacteristic != 2 - static_cast<std::int64_t>(shape.boundaryLoops)) {
    return refuse("has a handle");
  }

  const Mesh& mesh = *piece.mesh;
  std::vector<End> ends;
  std::vector<std::size_t> endOfVertex(mesh.vertexCount(), 0);
  for (const cutting::LoopTurning& loop : cutting::measureLoops(mesh)) {
    if (loop.isHole) continue;
    End& end = ends.emplace_back();
    for (const HalfedgeId h : loop.halfedges) {
      end.push_back(mesh.from(h));
      endOfVertex[mesh.from(h).index()] = ends.size() - 1;
    }
  }
  const auto add = [&](const SurfacePath& link) {
    const std::size_t number = cuts.size() + 1;
    cuts.push_back(makeCurveOnModel(
        piece, *model.mesh, link.points, fmt::format("autocut-{}-{}", piece.id, number),
        fmt::format("proposed cut {} of {}", number, piece.name), CurveKind::Seam));
  };
  for (const SurfacePath& link : symmetricCuts(piece, ends)) add(link);
  if (!cuts.empty()) return cuts;

  // Open ends are joined one by one, always the nearest to those joined (Prim's tree).
  std::vector<bool> isTarget(mesh.vertexCount(), false);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    for (const VertexId v : ends[i]) isTarget[v.index()] = true;
  }
  GeodesicLinker linker(piece.mesh);
  std::vector<VertexId> joined = ends.front();
  while (cuts.size() + 1 < ends.size()) {
    const std::vector<VertexId> path = shortestEdgePath(mesh, joined, isTarget);
    if (path.empty()) return refuse("falls apart");
    const End& from = ends[endOfVertex[path.front().index()]];
    const End& to = ends[endOfVertex[path.back().index()]];
    const auto link = shortestLink(linker, mesh, {&from, &to}, path);
    if (!link) return link.error().during("cut of piece \"" + piece.id + "\"");
    add(*link);
    for (const VertexId v : to) isTarget[v.index()] = false;
    joined.insert(joined.end(), to.begin(), to.end());
  }
  return cuts;
}

}  // namespace toile
