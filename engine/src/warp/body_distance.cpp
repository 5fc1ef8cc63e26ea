// SPDX-License-Identifier: GPL-3.0-or-later
#include "warp/body_distance.h"

#include <algorithm>

#include "toile/core/parallel.h"
#include "toile/curve/curvature.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

/// Nearer than this the way from the surface to the point is rounding, mm.
constexpr double kOnSurface = 1e-7;

Vector3d pseudonormal(const Mesh& mesh, const SurfacePoint& point) {
  if (std::holds_alternative<VertexId>(point.at)) return smoothNormal(mesh, point);
  Vector3d sum = Vector3d::Zero();
  for (const FaceId face : facesOf(mesh, point)) sum += mesh.normal(face);
  return sum.stableNormalized();
}

}  // namespace

BodyDistance distanceTo(const SurfaceIndex& body, const Vector3d& p) {
  const ClosestPoint near = body.closestPoint(p);
  const Vector3d normal = pseudonormal(body.mesh(), near.point);
  const Vector3d way = p - near.position;
  const double side = way.dot(normal) >= 0 ? 1 : -1;
  if (near.distance < kOnSurface) return {side * near.distance, normal};
  return {side * near.distance, side / near.distance * way};
}

std::vector<BodyDistance> distancesTo(const SurfaceIndex& body,
                                      const std::vector<Vector3d>& points) {
  std::vector<BodyDistance> distances(points.size());
  constexpr std::size_t kChunk = 512;
  parallelFor((points.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(points.size(), (chunk + 1) * kChunk); ++i) {
      distances[i] = distanceTo(body, points[i]);
    }
  });
  return distances;
}

}  // namespace toile::detail
