// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <queue>

#include "cut/topology.h"
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

/// A closed row of vertices: an open end of a tube.
using End = std::vector<VertexId>;

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

  // Open ends are joined one by one, always the nearest to those joined (Prim's tree).
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
    const std::size_t number = cuts.size() + 1;
    cuts.push_back(makeCurveOnModel(
        piece, *model.mesh, link->points, fmt::format("autocut-{}-{}", piece.id, number),
        fmt::format("proposed cut {} of {}", number, piece.name), CurveKind::Seam));
    for (const VertexId v : to) isTarget[v.index()] = false;
    joined.insert(joined.end(), to.begin(), to.end());
  }
  return cuts;
}

}  // namespace toile
