// SPDX-License-Identifier: GPL-3.0-or-later
// The section is the border between the part of the surface below the plane and the rest. Vertices
// on the plane count as above, so every face has no or two crossed sides, and the path goes from
// face to face without special cases; a crossed side with its upper end on the plane is crossed at
// that vertex.
#include "mesh/plane_section.h"

#include <algorithm>
#include <cmath>

namespace toile::detail {
namespace {

class SectionTracer {
 public:
  SectionTracer(const Mesh& mesh, const Eigen::Vector3d& normal, double offset)
      : mesh_(mesh), height_(mesh.vertexCount()), isUsed_(mesh.faceCount(), 0) {
    // Heights this small are rounding; such vertices lie on the plane.
    const double largest =
        std::max(mesh.boxMin().cwiseAbs().maxCoeff(), mesh.boxMax().cwiseAbs().maxCoeff());
    const double tolerance = 1e-13 * (largest * normal.lpNorm<1>() + std::abs(offset));
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
      const double height = normal.dot(mesh.position(VertexId(v))) - offset;
      height_[VertexId(v)] = std::abs(height) <= tolerance ? 0.0 : height;
    }
  }

  std::vector<SurfacePath> trace() {
    std::vector<HalfedgeId> entries;  // one for each face that is crossed
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      const auto& [a, b, c] = mesh_.vertices(FaceId(f));
      if (isBelow(a) == isBelow(b) && isBelow(b) == isBelow(c)) continue;
      HalfedgeId h = mesh_.halfedge(FaceId(f), 0);
      while (!leadsDown(h)) h = mesh_.next(h);
      entries.push_back(h);
    }
    std::vector<SurfacePath> paths;
    // Open ones first: they begin where a crossed side has no face on the other side.
    for (const HalfedgeId h : entries) {
      if (!mesh_.opposite(h).isValid()) take(h, paths);
    }
    for (const HalfedgeId h : entries) {
      if (isUsed_[mesh_.face(h)] == 0) take(h, paths);
    }
    std::vector<double> lengths;
    std::vector<std::size_t> order;
    for (const SurfacePath& path : paths) {
      order.push_back(order.size());
      lengths.push_back(length(mesh_, path));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
    std::vector<SurfacePath> sorted;
    for (const std::size_t i : order) sorted.push_back(std::move(paths[i]));
    return sorted;
  }

 private:
  [[nodiscard]] bool isBelow(VertexId v) const { return height_[v] < 0; }
  [[nodiscard]] bool leadsDown(HalfedgeId h) const {
    return !isBelow(mesh_.from(h)) && isBelow(mesh_.to(h));
  }
  [[nodiscard]] bool leadsUp(HalfedgeId h) const {
    return isBelow(mesh_.from(h)) && !isBelow(mesh_.to(h));
  }

  /// Where the plane crosses the side; the same from both faces.
  [[nodiscard]] SurfacePoint crossing(HalfedgeId h) const {
    if (height_[mesh_.from(h)] == 0) return {mesh_.from(h)};
    if (height_[mesh_.to(h)] == 0) return {mesh_.to(h)};
    const EdgeId e = mesh_.edge(h);
    const double tail = height_[mesh_.tail(e)];
    const double head = height_[mesh_.head(e)];
    const double t = tail / (tail - head);
    return {SurfacePoint::OnEdge{e, std::clamp(t, 1e-15, 1 - 1e-15)}};
  }

  /// Of a face entered through one side and left through another: whether the plane really cuts
  /// the surface there. Along an edge on the plane with both faces below it only touches.
  [[nodiscard]] bool cuts(HalfedgeId enter, HalfedgeId leave) const {
    const SurfacePoint a = crossing(enter);
    const SurfacePoint b = crossing(leave);
    const auto* from = std::get_if<VertexId>(&a.at);
    const auto* to = std::get_if<VertexId>(&b.at);
    if (from == nullptr || to == nullptr) return true;
    if (*from == *to) return false;
    // Two vertices on the plane: the face has only one side between them.
    HalfedgeId side = mesh_.next(enter);
    if (side == leave) side = mesh_.next(leave);
    const HalfedgeId across = mesh_.opposite(side);
    return !across.isValid() || !isBelow(mesh_.to(mesh_.next(across)));
  }

  /// The path that enters a face through `start`, up on its left.
  void take(HalfedgeId start, std::vector<SurfacePath>& paths) {
    SurfacePath path;
    path.points.push_back(crossing(start));
    HalfedgeId enter = start;
    bool isCut = false;
    do {
      isUsed_[mesh_.face(enter)] = 1;
      HalfedgeId leave = mesh_.next(enter);
      if (!leadsUp(leave)) leave = mesh_.next(leave);
      isCut = isCut || cuts(enter, leave);
      path.faceOfSegment.push_back(mesh_.face(enter));
      path.points.push_back(crossing(leave));
      enter = mesh_.opposite(leave);
    } while (enter.isValid() && enter != start);
    if (!isCut) return;
    path.closed = enter.isValid();
    clean(path);
    const std::size_t least = path.closed ? 3 : 2;
    if (path.points.size() >= least) paths.push_back(std::move(path));
  }

  /// Takes out steps that do not move (past a vertex) and ways out and back along edges that touch
  /// the plane from below.
  static void clean(SurfacePath& path) {
    std::vector<SurfacePoint> points;
    std::vector<FaceId> faces;  // of the segment that ends at the point
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const FaceId face = i == 0 ? FaceId() : path.faceOfSegment[i - 1];
      if (!points.empty() && points.back() == path.points[i]) continue;
      if (points.size() > 1 && points[points.size() - 2] == path.points[i]) {
        points.pop_back();
        faces.pop_back();
        continue;
      }
      points.push_back(path.points[i]);
      faces.push_back(face);
    }
    std::size_t begin = 0;
    if (path.closed) {
      // First and last are the same point; a way out and back may lie across the start.
      while (points.size() - begin > 3 && points[begin + 1] == points[points.size() - 2]) {
        ++begin;
        points.pop_back();
        faces.pop_back();
      }
      points.pop_back();
    }
    path.points.assign(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end());
    path.faceOfSegment.assign(faces.begin() + static_cast<std::ptrdiff_t>(begin) + 1, faces.end());
  }

  const Mesh& mesh_;
  VertexData<double> height_;
  FaceData<char> isUsed_;  // a path leads through it
};

}  // namespace

std::vector<SurfacePath> computePlaneSection(const Mesh& mesh, const Eigen::Vector3d& normal,
                                             double offset) {
  if (!normal.allFinite() || !std::isfinite(offset) || normal.isZero(0)) return {};
  return SectionTracer(mesh, normal, offset).trace();
}

}  // namespace toile::detail
