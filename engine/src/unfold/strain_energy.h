// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "unfold/energy_term.h"

namespace toile::unfolding {

/// Singular values of a 2x2 map and its derivatives' directions.
///
/// F = Q R + P S with a rotation R and a reflection S; s1 = Q + P, s2 = Q - P, so that no
/// trigonometry is needed.
struct PlaneMap {
  double xx = 0, xy = 0, yx = 0, yy = 0;  ///< F, row by row
  [[nodiscard]] double determinant() const { return xx * yy - xy * yx; }
};
[[nodiscard]] PlaneMap mapOf(const RestTriangle& triangle, const Plane& q);
/// Larger one first; the smaller one is negative for a flipped triangle.
[[nodiscard]] std::array<double, 2> singularValues(const PlaneMap& map);

/// Sum over the triangles of A D,
///   D = s1^2 + s2^2 + 1/s1^2 + 1/s2^2 - 4 + 2 kappa (J + 1/J - 2),  J = s1 s2:
/// symmetric Dirichlet energy and a price on area change. Infinite for flipped triangles.
class StrainEnergy : public EnergyTerm {
 public:
  /// @param areaWeight kappa >= 0.
  StrainEnergy(const Problem& problem, const BlockPattern& pattern, double areaWeight);

  [[nodiscard]] double energy(const Plane& q) const override;
  void addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                      BlockMatrix& hessian) const override;
  [[nodiscard]] double distanceToBorder(const Plane& q, const Plane& d) const override;

 private:
  const Problem* problem_;
  double areaWeight_;
  std::vector<std::array<BlockPattern::Place, 3>> places_;  ///< of the sides 01, 12, 20
};

}  // namespace toile::unfolding
