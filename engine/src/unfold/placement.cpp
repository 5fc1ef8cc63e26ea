// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "unfold/check.h"
#include "unfold/strain_energy.h"

namespace toile::unfolding {
namespace {

/// Below this mean slope a piece is level, and its up is the next of z, y, x.
constexpr double kLevel = 1e-2;

/// Mean of a direction of the model, laid into each face and carried to the plane.
Eigen::Vector2d meanDirection(const Problem& problem, const std::vector<Eigen::Vector3d>& positions,
                              const Plane& q, const Eigen::Vector3d& direction) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const RestTriangle& t : problem.triangles) {
    // grad(direction . x) in the face is the direction's part in the face, in the face's frame.
    Eigen::Vector2d inFace = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      inFace += direction.dot(positions[t.vertex[k]] - positions[t.vertex[0]]) * t.hatGradient[k];
    }
    const PlaneMap f = mapOf(t, q);
    sum += t.area * Eigen::Vector2d(f.xx * inFace.x() + f.xy * inFace.y(),
                                    f.yx * inFace.x() + f.yy * inFace.y());
  }
  return sum / problem.area;
}

}  // namespace

void place(const Problem& problem, const std::vector<Eigen::Vector3d>& positions, bool isSymmetric,
           Plane& q) {
  // A symmetric plane has its axis on x = 0, to the last bit: it is turned by quarters alone.
  bool axisIsUpright = true;
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 0, 0)}) {
    const Eigen::Vector2d up = meanDirection(problem, positions, q, axis);
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
