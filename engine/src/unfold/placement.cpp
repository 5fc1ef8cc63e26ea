// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "unfold/check.h"
#include "unfold/triangle_energy.h"

namespace toile::unfolding {
namespace {

/// Below this mean slope a piece is level, and its up is the next of the grain, z, y, x.
constexpr double kLevel = 1e-2;

/// Mean of a direction in each face, carried to the plane.
Eigen::Vector2d meanDirection(const Problem& problem, const Plane& q,
                              const std::vector<Eigen::Vector2d>& inFace) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < problem.triangles.size(); ++i) {
    const PlaneMap f = mapOf(problem.triangles[i], q);
    const Eigen::Vector2d& d = inFace[i];
    sum += problem.triangles[i].area *
           Eigen::Vector2d(f.xx * d.x() + f.xy * d.y(), f.yx * d.x() + f.yy * d.y());
  }
  return sum / problem.area;
}

/// The parts in the faces of a direction of the model: grad(direction . x), in each face's frame.
std::vector<Eigen::Vector2d> inFaces(const Problem& problem,
                                     const std::vector<Eigen::Vector3d>& positions,
                                     const Eigen::Vector3d& direction) {
  std::vector<Eigen::Vector2d> parts;
  parts.reserve(problem.triangles.size());
  for (const RestTriangle& t : problem.triangles) {
    Eigen::Vector2d& part = parts.emplace_back(Eigen::Vector2d::Zero());
    for (std::size_t k = 0; k < 3; ++k) {
      part += direction.dot(positions[t.vertex[k]] - positions[t.vertex[0]]) * t.hatGradient[k];
    }
  }
  return parts;
}

}  // namespace

void place(const Problem& problem, const std::vector<Eigen::Vector3d>& positions, bool isSymmetric,
           Plane& q) {
  // A symmetric plane has its axis on x = 0, to the last bit: it is turned by quarters alone.
  bool axisIsUpright = true;
  for (int choice = problem.grain.empty() ? 2 : 3; choice >= 0; --choice) {
    const Eigen::Vector2d up = meanDirection(
        problem, q,
        choice == 3 ? problem.grain : inFaces(problem, positions, Eigen::Vector3d::Unit(choice)));
    if (up.norm() < kLevel) continue;
    Eigen::Vector2d u = up.normalized();
    if (isSymmetric) {
      axisIsUpright = std::abs(u.y()) >= std::abs(u.x());
      u = axisIsUpright ? Eigen::Vector2d(0, u.y() < 0 ? -1 : 1)
                        : Eigen::Vector2d(u.x() < 0 ? -1 : 1, 0);
    }
    for (Eigen::Index i = 0; i < q.size(); i += 2) {
      const Eigen::Vector2d p(q[i], q[i + 1]);
      q[i] = u.y() * p.x() - u.x() * p.y();
      q[i + 1] = u.dot(p);
    }
    break;
  }
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double area = 0;
  for (const RestTriangle& t : problem.triangles) {
    const double flat = t.area * mapOf(t, q).determinant();
    moment += flat / 3 * (at(q, t.vertex[0]) + at(q, t.vertex[1]) + at(q, t.vertex[2]));
    area += flat;
  }
  Eigen::Vector2d centroid = moment / area;
  if (isSymmetric) centroid[axisIsUpright ? 0 : 1] = 0;
  for (Eigen::Index i = 0; i < q.size(); i += 2) q.segment<2>(i) -= centroid;
}

}  // namespace toile::unfolding
