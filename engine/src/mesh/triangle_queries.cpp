// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_queries.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace toile::detail {
namespace {

/// How far along from a to b the point nearest to p is, 0..1.
double closestAlong(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  const double length2 = ab.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
}

Eigen::Vector3d closestOnSides(const Eigen::Vector3d& p,
                               const std::array<Eigen::Vector3d, 3>& corners) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double bestDistance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const Eigen::Vector3d& a = corners[static_cast<std::size_t>(k)];
    const Eigen::Vector3d& b = corners[static_cast<std::size_t>(l)];
    const double t = closestAlong(p, a, b);
    const double distance = (p - ((1 - t) * a + t * b)).squaredNorm();
    if (distance >= bestDistance) continue;
    bestDistance = distance;
    best.setZero();
    best[k] = 1 - t;
    best[l] = t;
  }
  return best;
}

}  // namespace

Eigen::Vector3d closestWeights(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  // Below that the plane of the triangle is not known well enough to project on it.
  if (area2 > 1e-24 * ab.squaredNorm() * ac.squaredNorm()) {
    const Eigen::Vector3d ap = p - a;
    const double v = ap.cross(ac).dot(normal) / area2;
    const double w = ab.cross(ap).dot(normal) / area2;
    const double u = 1 - v - w;
    if (u > 0 && v > 0 && w > 0) return {u, v, w};
  }
  return closestOnSides(p, {a, b, c});
}

RayTriangleTest::RayTriangleTest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
    : origin_(origin) {
  direction.cwiseAbs().maxCoeff(&z_);
  x_ = (z_ + 1) % 3;
  y_ = (z_ + 2) % 3;
  // Keeps the handedness when the ray looks down its axis.
  if (direction[z_] < 0) std::swap(x_, y_);
  shear_ = {direction[x_] / direction[z_], direction[y_] / direction[z_], 1 / direction[z_]};
}

Eigen::Vector3d RayTriangleTest::sheared(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d d = p - origin_;
  return {d[x_] - shear_[0] * d[z_], d[y_] - shear_[1] * d[z_], shear_[2] * d[z_]};
}

std::optional<RayTriangleTest::Hit> RayTriangleTest::meet(const Eigen::Vector3d& a,
                                                          const Eigen::Vector3d& b,
                                                          const Eigen::Vector3d& c) const {
  const Eigen::Vector3d sa = sheared(a);
  const Eigen::Vector3d sb = sheared(b);
  const Eigen::Vector3d sc = sheared(c);
  // Twice the signed areas that the ray's foot makes with the sides opposite to a, b, c.
  const double u = sc.x() * sb.y() - sc.y() * sb.x();
  const double v = sa.x() * sc.y() - sa.y() * sc.x();
  const double w = sb.x() * sa.y() - sb.y() * sa.x();
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
  const double sum = u + v + w;
  if (sum == 0) return std::nullopt;
  Hit hit;
  hit.weights = Eigen::Vector3d(u, v, w) / sum;
  hit.t = hit.weights.dot(Eigen::Vector3d(sa.z(), sb.z(), sc.z()));
  if (!(hit.t >= 0)) return std::nullopt;
  hit.facesOrigin = sum > 0;
  return hit;
}

}  // namespace toile::detail
