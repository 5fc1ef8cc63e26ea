// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "unfold/block_matrix.h"
#include "unfold/elimination.h"

namespace toile::unfolding {

/// Multifrontal Cholesky factor L L^T of matrices on one pattern: ordered and analysed once,
/// factored as often as wanted. One thread; the same bits in every run and on every processor.
/// @see Liu, "The Multifrontal Method for Sparse Matrix Solution", SIAM Review 34(1), 1992.
class SparseFactor {
 public:
  explicit SparseFactor(const BlockPattern& pattern);

  /// False if the matrix is not positive definite; solve() may not be called then.
  [[nodiscard]] bool factor(const BlockMatrix& matrix);
  /// x = A^-1 b with the last matrix factored.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

  /// Numbers that the factor holds.
  [[nodiscard]] std::size_t size() const { return panels_.size(); }

 private:
  Elimination elimination_;
  std::vector<std::size_t> panelStart_;  ///< of each supernode, column-major, in panels_
  /// The numbers of the matrix that a supernode takes, and where in its panel they go.
  std::vector<std::size_t> moveStart_;
  std::vector<int> moveFrom_;
  std::vector<std::uint32_t> moveTo_;
  std::vector<double> panels_;
  std::vector<double> stack_;         ///< updates that wait for their parents
  std::vector<std::size_t> waiting_;  ///< whose they are
  std::vector<double> front_, packed_, x_;
};

}  // namespace toile::unfolding
