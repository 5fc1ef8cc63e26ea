// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace toile::unfolding {

/// The x in [low, high] that makes gradient . x + x . hessian x / 2 least, for few unknowns.
///
/// Directions in which the hessian does not curve up are taken to curve up a little, so that there
/// is one answer.
[[nodiscard]] Eigen::VectorXd minimumInBox(const Eigen::VectorXd& gradient,
                                           const Eigen::MatrixXd& hessian,
                                           const Eigen::VectorXd& low, const Eigen::VectorXd& high);

}  // namespace toile::unfolding
