// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "unfold/triangle_energy.h"

namespace toile::unfolding {

/// Sum over the triangles of A D,
///   D = s1^2 + s2^2 + 1/s1^2 + 1/s2^2 - 4 + 2 kappa (J + 1/J - 2),  J = s1 s2:
/// symmetric Dirichlet energy and a price on area change. s1, s2 are the singular values of the
/// map, which is split as F = Q rotation + P reflection with s1 = Q + P, s2 = Q - P, so that no
/// trigonometry is needed.
class StrainEnergy : public TriangleEnergy {
 public:
  /// @param areaWeight kappa >= 0.
  StrainEnergy(const Problem& problem, const BlockPattern& pattern, double areaWeight)
      : TriangleEnergy(problem, pattern), areaWeight_(areaWeight) {}

  [[nodiscard]] double energy(const Plane& q) const override;
  void addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                      BlockMatrix& hessian) const override;

 private:
  double areaWeight_;
};

}  // namespace toile::unfolding
