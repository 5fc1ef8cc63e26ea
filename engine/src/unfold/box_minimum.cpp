// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/box_minimum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace toile::unfolding {

Eigen::VectorXd minimumInBox(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                             const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  constexpr int kMaxSweeps = 500;
  constexpr double kLeastCurvature = 1e-9;
  const Eigen::Index n = gradient.size();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 *
                                                              (hessian + hessian.transpose()));
  const double floor =
      kLeastCurvature * std::max(solver.eigenvalues().cwiseAbs().maxCoeff(), 1e-300);
  const Eigen::MatrixXd convex = solver.eigenvectors() *
                                 solver.eigenvalues().cwiseMax(floor).asDiagonal() *
                                 solver.eigenvectors().transpose();
  // One unknown after the other, each to its own minimum: converges for convex functions in boxes.
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n).cwiseMax(low).cwiseMin(high);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double moved = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double slope = gradient[i] + convex.row(i).dot(x);
      const double to = std::clamp(x[i] - slope / convex(i, i), low[i], high[i]);
      moved = std::max(moved, std::abs(to - x[i]));
      x[i] = to;
    }
    if (moved < 1e-15) break;
  }
  return x;
}

}  // namespace toile::unfolding
