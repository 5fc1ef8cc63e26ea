// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "toile/curve/geodesic.h"

namespace toile {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

double angleBetween(const Vector3d& u, const Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Direction within the face from one of its points to another. Taken from the differences of the
/// weights, relative to the corner nearest to the point: exact for neighbours close to a vertex.
Vector3d direction(const Mesh& mesh, FaceId face, const SurfacePoint& from,
                   const SurfacePoint& to) {
  const Vector3d weights = barycentricIn(mesh, from, face);
  const Vector3d change = barycentricIn(mesh, to, face) - weights;
  Eigen::Index nearest = 0;
  weights.maxCoeff(&nearest);
  const Triangle& corners = mesh.vertices(face);
  const Vector3d& origin = mesh.position(corners[static_cast<std::size_t>(nearest)]);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += change[static_cast<Eigen::Index>(k)] * (mesh.position(corners[k]) - origin);
  }
  return sum;
}

/// The surface around a point of a path: angles are measured counter-clockwise from a reference
/// direction and run to `all`.
struct Surroundings {
  double all = 2 * pi;
  bool isBorder = false;
};

Surroundings surroundings(const Mesh& mesh, const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) {
    double sum = 0;
    for (const FaceId f : mesh.facesAround(*v)) {
      const Triangle& c = mesh.vertices(f);
      const auto k = static_cast<std::size_t>(std::find(c.begin(), c.end(), *v) - c.begin());
      const Vector3d& p = mesh.position(*v);
      sum += angleBetween(mesh.position(c[(k + 1) % 3]) - p, mesh.position(c[(k + 2) % 3]) - p);
    }
    return {sum, mesh.isBorder(*v)};
  }
  if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    if (mesh.isBorder(on->edge)) return {pi, true};
  }
  return {};
}

/// The angle of the direction from a point of the path to another one in the same face.
double angleTowards(const Mesh& mesh, FaceId face, const SurfacePoint& point,
                    const SurfacePoint& to) {
  const Vector3d d = direction(mesh, face, point, to);
  if (const auto* v = std::get_if<VertexId>(&point.at)) {
    double before = 0;
    const Vector3d& p = mesh.position(*v);
    for (const FaceId f : mesh.facesAround(*v)) {
      const Triangle& c = mesh.vertices(f);
      const auto k = static_cast<std::size_t>(std::find(c.begin(), c.end(), *v) - c.begin());
      const Vector3d first = mesh.position(c[(k + 1) % 3]) - p;
      if (f == face) return before + angleBetween(first, d);
      before += angleBetween(first, mesh.position(c[(k + 2) % 3]) - p);
    }
  }
  if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    const HalfedgeId h = mesh.halfedge(on->edge);
    const Vector3d along = mesh.position(mesh.to(h)) - mesh.position(mesh.from(h));
    const double angle = angleBetween(along, d);
    return mesh.face(h) == face ? angle : 2 * pi - angle;
  }
  const auto& [a, b, c] = mesh.vertices(face);
  const Vector3d along = mesh.position(b) - mesh.position(a);
  const Vector3d normal = along.cross(mesh.position(c) - mesh.position(a));
  const double angle = angleBetween(along, d);
  return normal.dot(along.cross(d)) >= 0 ? angle : 2 * pi - angle;
}

double defectAt(const Mesh& mesh, const SurfacePoint& point, double towardsPrevious,
                double towardsNext) {
  const Surroundings around = surroundings(mesh, point);
  const double between = std::abs(towardsNext - towardsPrevious);
  // At the border the other side has no surface to take a short cut over.
  const double outside =
      around.isBorder ? std::numeric_limits<double>::infinity() : around.all - between;
  return std::max(0.0, pi - std::min(between, outside));
}

}  // namespace

double geodesicDefect(const Mesh& mesh, const SurfacePath& path) {
  const std::size_t count = path.points.size();
  double worst = 0;
  for (std::size_t i = path.closed ? 0 : 1; i + (path.closed ? 0 : 1) < count; ++i) {
    const SurfacePoint& point = path.points[i];
    const std::size_t before = (i + count - 1) % count;
    const double in = angleTowards(mesh, path.faceOfSegment[before], point, path.points[before]);
    const double out =
        angleTowards(mesh, path.faceOfSegment[i], point, path.points[(i + 1) % count]);
    worst = std::max(worst, defectAt(mesh, point, in, out));
  }
  return worst;
}

}  // namespace toile
