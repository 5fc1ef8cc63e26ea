// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/local_closest.h"

#include "mesh/triangle_queries.h"

namespace toile::detail {

using Eigen::Vector3d;

SurfacePoint LocalClosest::find(const Vector3d& place, const SurfacePoint& guide) {
  return find(place, guide, 2 * (place - position(mesh_, guide)).norm());
}

SurfacePoint LocalClosest::find(const Vector3d& place, const SurfacePoint& guide, double radius) {
  ++call_;
  const Vector3d centre = position(mesh_, guide);
  queue_ = facesOf(mesh_, guide);
  for (const FaceId f : queue_) seen_[f.index()] = call_;

  SurfacePoint best = guide;
  double bestDistance = (place - centre).norm();
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const FaceId face = queue_[i];
    const auto& [a, b, c] = mesh_.vertices(face);
    const Vector3d &pa = mesh_.position(a), &pb = mesh_.position(b), &pc = mesh_.position(c);
    const auto at = [&](const Vector3d& w) -> Vector3d {
      return w[0] * pa + w[1] * pb + w[2] * pc;
    };
    if ((at(closestWeights(centre, pa, pb, pc)) - centre).norm() > radius) continue;
    const Vector3d weights = closestWeights(place, pa, pb, pc);
    const double distance = (at(weights) - place).norm();
    if (distance < bestDistance) {
      bestDistance = distance;
      best = makeSurfacePoint(mesh_, face, weights);
    }
    for (int side = 0; side < 3; ++side) {
      const HalfedgeId o = mesh_.opposite(mesh_.halfedge(face, side));
      if (!o.isValid() || seen_[mesh_.face(o).index()] == call_) continue;
      seen_[mesh_.face(o).index()] = call_;
      queue_.push_back(mesh_.face(o));
    }
  }
  return best;
}

}  // namespace toile::detail
