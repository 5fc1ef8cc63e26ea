// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "unfold/triangle_energy.h"

namespace toile::unfolding {

/// The warp's unit direction in each triangle's own plane.
[[nodiscard]] std::vector<Eigen::Vector2d> grainOf(const Problem& problem,
                                                   const std::vector<Eigen::Vector3d>& positions,
                                                   const Grain& grain);

/// Strain of cloth that is not alike in all directions. With the images u, v of the unit directions
/// along and across the grain, sum over the triangles of A D,
///   D = kw (|u| - 1/|u|)^2 + kf (|v| - 1/|v|)^2 + 2 ks (u.v)^2 + 2 kappa (J + 1/J - 2);
/// for kw = kf = ks = 1 and small strains that is StrainEnergy. What goes beyond the limits of the
/// fabric costs a hundred times as much.
class ClothEnergy : public TriangleEnergy {
 public:
  /// @param problem with its grain.
  /// @param areaWeight kappa; at least a little of it keeps triangles from folding.
  ClothEnergy(const Problem& problem, const BlockPattern& pattern, const Cloth& cloth,
              double areaWeight);

  [[nodiscard]] double energy(const Plane& q) const override;
  void addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                      BlockMatrix& hessian) const override;

 private:
  /// A function of one number with its derivatives.
  struct Jet {
    double value = 0, first = 0, second = 0;
  };
  [[nodiscard]] static Jet stretching(double length, double weight, double limit);
  [[nodiscard]] Jet shearing(double s) const;
  [[nodiscard]] Jet areaChange(double j) const;

  double along_, across_, shear_, area_;
  double limitAlong_, limitAcross_, limitShear_;
};

}  // namespace toile::unfolding
