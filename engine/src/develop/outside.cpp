// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cmath>

#include "develop/shape.h"

namespace toile::developing {
namespace {

using Eigen::Vector3d;

/// The outward direction at a surface point: the normals of its faces, on a vertex weighted by
/// their angles there, which tells inside from outside wherever the nearest point lies.
/// @see Baerentzen and Aanaes, "Signed distance computation using the angle weighted
///   pseudonormal", IEEE TVCG 11(3), 2005.
Vector3d outwardAt(const Mesh& mesh, const SurfacePoint& point) {
  Vector3d sum = Vector3d::Zero();
  const auto* vertex = std::get_if<VertexId>(&point.at);
  for (const FaceId f : facesOf(mesh, point)) {
    double weight = 1;
    if (vertex != nullptr) {
      const Triangle& t = mesh.vertices(f);
      const std::size_t k = t[0] == *vertex ? 0 : t[1] == *vertex ? 1 : 2;
      const Vector3d u = mesh.position(t[(k + 1) % 3]) - mesh.position(*vertex);
      const Vector3d w = mesh.position(t[(k + 2) % 3]) - mesh.position(*vertex);
      weight = std::atan2(u.cross(w).norm(), u.dot(w));
    }
    sum += weight * mesh.normal(f);
  }
  return sum.normalized();
}

}  // namespace

double signedDistance(const SurfaceIndex& surface, const Vector3d& place) {
  const ClosestPoint closest = surface.closestPoint(place);
  const Vector3d outward = outwardAt(surface.mesh(), closest.point);
  return (place - closest.position).dot(outward) < 0 ? -closest.distance : closest.distance;
}

void pushOutside(const Mesh& mesh, const SurfaceIndex& surface, double gap, Positions& at) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (mesh.isBorder(VertexId(i))) continue;
    const ClosestPoint closest = surface.closestPoint(at[i]);
    const Vector3d outward = outwardAt(surface.mesh(), closest.point);
    const double side = (at[i] - closest.position).dot(outward) < 0 ? -1 : 1;
    if (side * closest.distance < gap) at[i] = closest.position + gap * outward;
  }
}

}  // namespace toile::developing
