// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "unfold/start.h"

namespace toile::unfolding {

// The conformal energy of a triangle is 2 A P^2, P the size of the reflection part of its map:
// two squares, of (xx - yy) / 2 and (xy + yx) / 2, which are linear in the positions.
std::optional<Plane> conformalStart(const Problem& problem,
                                    const std::vector<Eigen::Vector3d>& positions,
                                    std::pair<std::uint32_t, std::uint32_t> pins,
                                    const BlockPattern& pattern, SparseFactor& factor) {
  // Springs this stiff hold the pins to a millionth; the scale is set afterwards anyway.
  constexpr double kPinStiffness = 1e6;
  BlockMatrix matrix(pattern);
  for (const RestTriangle& t : problem.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d& g = t.hatGradient[k];
      const Eigen::Vector2d& n = t.hatGradient[(k + 1) % 3];
      matrix.addDiagonal(t.vertex[k], t.area * g.squaredNorm(), 0, t.area * g.squaredNorm());
      const double dot = t.area * g.dot(n);
      const double cross = t.area * (g.x() * n.y() - g.y() * n.x());
      Eigen::Matrix2d block;
      block << dot, -cross, cross, dot;
      matrix.add(pattern.find(t.vertex[k], t.vertex[(k + 1) % 3]), block);
    }
  }
  const double distance = (positions[pins.first] - positions[pins.second]).norm();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(problem.vertexCount));
  matrix.addDiagonal(pins.first, kPinStiffness, 0, kPinStiffness);
  matrix.addDiagonal(pins.second, kPinStiffness, 0, kPinStiffness);
  // With ties the axis is x = 0, and the pins lie on it.
  const MirrorTies& ties = pattern.ties();
  const Eigen::Index along = ties.empty() ? 0 : 1;
  force[2 * Eigen::Index{pins.first} + along] = -0.5 * kPinStiffness * distance;
  force[2 * Eigen::Index{pins.second} + along] = 0.5 * kPinStiffness * distance;
  matrix.fillAxis();
  if (!factor.factor(matrix)) return std::nullopt;
  Plane q;
  factor.solve(ties.reduce(force), q);
  q = ties.expand(q);
  if (!q.allFinite()) return std::nullopt;
  scaleToLeastStrain(problem, q);
  return q;
}

}  // namespace toile::unfolding
