// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/surface_index.h"

#include <algorithm>
#include <limits>

#include "mesh/bounding_tree.h"
#include "mesh/plane_section.h"
#include "mesh/triangle_queries.h"

namespace toile {

struct SurfaceIndex::Tree {
  explicit Tree(std::shared_ptr<const Mesh> of) : mesh(std::move(of)), boxes(*mesh) {}
  std::shared_ptr<const Mesh> mesh;
  detail::BoundingTree boxes;
};

SurfaceIndex::SurfaceIndex(std::shared_ptr<const Mesh> mesh)
    : tree_(std::make_unique<Tree>(std::move(mesh))) {}
SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;

const Mesh& SurfaceIndex::mesh() const {
  return *tree_->mesh;
}

ClosestPoint SurfaceIndex::closestPoint(const Eigen::Vector3d& to) const {
  const Mesh& m = mesh();
  FaceId bestFace(0);
  Eigen::Vector3d bestWeights = Eigen::Vector3d::UnitX();
  double best = std::numeric_limits<double>::infinity();
  tree_->boxes.visitNear(to, [&](FaceId face) {
    const auto& [a, b, c] = m.vertices(face);
    const Eigen::Vector3d& pa = m.position(a);
    const Eigen::Vector3d& pb = m.position(b);
    const Eigen::Vector3d& pc = m.position(c);
    const Eigen::Vector3d weights = detail::closestWeights(to, pa, pb, pc);
    const double distance =
        (to - (weights[0] * pa + weights[1] * pb + weights[2] * pc)).squaredNorm();
    // Faces that meet at the nearest point tie; the first of them, whatever the tree's order.
    if (distance < best || (distance == best && face < bestFace)) {
      best = distance;
      bestFace = face;
      bestWeights = weights;
    }
    return best;
  });
  ClosestPoint result;
  result.point = makeSurfacePoint(m, bestFace, bestWeights);
  result.position = position(m, result.point);
  result.distance = (to - result.position).norm();
  return result;
}

std::vector<RayHit> SurfaceIndex::rayHits(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction) const {
  if (!origin.allFinite() || !direction.allFinite() || direction.isZero(0)) return {};
  const Mesh& m = mesh();
  struct Met {
    FaceId face;
    detail::RayTriangleTest::Hit hit;
  };
  std::vector<Met> met;
  const detail::RayTriangleTest test(origin, direction);
  tree_->boxes.visitAlong(origin, direction, [&](FaceId face) {
    const auto& [a, b, c] = m.vertices(face);
    if (const auto hit = test.meet(m.position(a), m.position(b), m.position(c))) {
      met.push_back({face, *hit});
    }
  });
  std::sort(met.begin(), met.end(), [](const Met& x, const Met& y) {
    return x.hit.t != y.hit.t ? x.hit.t < y.hit.t : x.face < y.face;
  });
  std::vector<RayHit> hits;
  for (const Met& one : met) {
    RayHit hit;
    hit.point = makeSurfacePoint(m, one.face, one.hit.weights);
    // A ray through an edge or a vertex meets all its faces there, which is one hit.
    const auto isSame = [&](const RayHit& other) {
      const auto* edge = std::get_if<SurfacePoint::OnEdge>(&hit.point.at);
      const auto* otherEdge = std::get_if<SurfacePoint::OnEdge>(&other.point.at);
      if (edge != nullptr && otherEdge != nullptr) return edge->edge == otherEdge->edge;
      return std::holds_alternative<VertexId>(hit.point.at) && hit.point == other.point;
    };
    const auto same = std::find_if(hits.begin(), hits.end(), isSame);
    if (same != hits.end()) {
      same->facesOrigin = same->facesOrigin || one.hit.facesOrigin;
      continue;
    }
    hit.position = position(m, hit.point);
    hit.t = one.hit.t;
    hit.facesOrigin = one.hit.facesOrigin;
    hits.push_back(std::move(hit));
  }
  return hits;
}

std::optional<RayHit> SurfaceIndex::firstVisibleHit(const Eigen::Vector3d& origin,
                                                    const Eigen::Vector3d& direction) const {
  for (RayHit& hit : rayHits(origin, direction)) {
    if (hit.facesOrigin) return std::move(hit);
  }
  return std::nullopt;
}

std::vector<SurfacePath> SurfaceIndex::planeSection(const Eigen::Vector3d& normal,
                                                    double offset) const {
  return detail::computePlaneSection(mesh(), normal, offset);
}

}  // namespace toile
