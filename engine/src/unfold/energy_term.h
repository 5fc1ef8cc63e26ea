// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "unfold/block_matrix.h"
#include "unfold/problem.h"

namespace toile::unfolding {

/// A part of what the solver makes small; objectives are lists of terms.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  /// Infinite where the term is not defined (a flipped triangle).
  [[nodiscard]] virtual double energy(const Plane& q) const = 0;
  /// Adds the gradient, and an approximation of the Hessian: positive semi-definite for
  /// `indefinite` = 0; of what may make it indefinite that fraction is counted.
  virtual void addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                              BlockMatrix& hessian) const = 0;
  /// The t > 0 at which q + t d leaves the domain; infinite if it never does.
  [[nodiscard]] virtual double distanceToBorder(const Plane& /*q*/, const Plane& /*d*/) const {
    return std::numeric_limits<double>::infinity();
  }
  /// The solver has moved here: a term that follows something by continuity takes note.
  virtual void moveTo(const Plane& /*q*/) {}
};

}  // namespace toile::unfolding
