// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "unfold/block_matrix.h"
#include "unfold/problem.h"

namespace toile::unfolding {

/// The constraints c_e = |q_a - q_b| - (1 + ratio) target = 0 on all wire edges, with Jacobian J by
/// q; the ratio is that of the edge's elastic line, 0 for all others.
class WireLengths {
 public:
  WireLengths(const Problem& problem, const BlockPattern& pattern);

  [[nodiscard]] std::size_t count() const { return problem_->wireEdges.size(); }
  [[nodiscard]] std::size_t elasticCount() const { return problem_->elastics.size(); }
  /// How far the ratios may go, either way.
  [[nodiscard]] Eigen::VectorXd ranges() const;
  /// @param ratios one per elastic line.
  [[nodiscard]] Eigen::VectorXd residual(const Plane& q, const Eigen::VectorXd& ratios) const;
  /// The targets of an elastic line, 0 at all other edges: by how much c falls with its ratio.
  [[nodiscard]] Eigen::VectorXd targetsOf(std::size_t elastic) const;
  /// Greatest |c_e| as a share of its target (of a thousandth of the mean edge for tiny ones).
  [[nodiscard]] double worst(const Eigen::VectorXd& residual) const;
  /// Greatest |c_e| / max(target, 1 mm).
  [[nodiscard]] double worstForUser(const Eigen::VectorXd& residual) const;

  /// J and the curvature are taken here from now on.
  void linearise(const Plane& q);
  [[nodiscard]] Eigen::VectorXd jacobianTimes(const Eigen::VectorXd& d) const;
  void addTransposeTimes(const Eigen::VectorXd& y, Eigen::VectorXd& out) const;
  /// Adds penalty J^T J + sum lambda_e (I - u u^T) / |e|, of wires in compression (lambda_e < 0)
  /// only the fraction `compression`.
  void addCurvature(const Eigen::VectorXd& lambda, double compression, double penalty,
                    BlockMatrix& matrix) const;

 private:
  const Problem* problem_;
  std::vector<Eigen::Vector2d> direction_;
  std::vector<double> length_;
  std::vector<BlockPattern::Place> places_;
};

}  // namespace toile::unfolding
