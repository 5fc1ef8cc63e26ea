// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "unfold/energy_term.h"

namespace toile::unfolding {

/// Bending energy of the wires in the plane: sum stiffness (theta - alpha)^2 / span.
///
/// theta is followed by continuity, so that it may leave (0, 2 pi).
class WireBending : public EnergyTerm {
 public:
  /// @param theta of the corners at the start; see cornerAngles().
  WireBending(const Problem& problem, const BlockPattern& pattern, std::vector<double> theta);

  /// mm^3; (beta sqrt(area))^3 for wires that cannot wave below the length beta sqrt(area).
  void setStiffness(double stiffness) { stiffness_.assign(theta_.size(), stiffness); }
  /// One for each corner.
  void setStiffness(std::vector<double> stiffness) { stiffness_ = std::move(stiffness); }
  /// Counts the second derivatives of theta too: they bring nothing where the cloth's strain rules,
  /// and all where wires alone are bent.
  void useSecondDerivatives() { secondDerivatives_ = true; }

  [[nodiscard]] double energy(const Plane& q) const override;
  void addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                      BlockMatrix& hessian) const override;
  void moveTo(const Plane& q) override;
  [[nodiscard]] const std::vector<double>& theta() const { return theta_; }

 private:
  [[nodiscard]] double angle(std::size_t corner, const Plane& q) const;

  const Problem* problem_;
  bool secondDerivatives_ = false;
  std::vector<double> theta_, stiffness_;
  /// Of the pairs at-before, at-after, before-after.
  std::vector<std::array<BlockPattern::Place, 3>> places_;
};

/// Angles of all corners as sums of the triangles' angles: right if no triangle is flipped.
[[nodiscard]] std::vector<double> cornerAngles(const Problem& problem, const Plane& q);

}  // namespace toile::unfolding
