// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "unfold/block_matrix.h"

namespace toile::unfolding {

/// Supernodal Cholesky factor L L^T of matrices on one pattern: ordered and analysed once, factored
/// as often as wanted. One thread, and the same bits in every run.
class SparseFactor {
 public:
  explicit SparseFactor(const BlockPattern& pattern);
  ~SparseFactor();
  SparseFactor(const SparseFactor&) = delete;
  SparseFactor& operator=(const SparseFactor&) = delete;

  /// False if the matrix is not positive definite; solve() may not be called then. Throws
  /// std::bad_alloc when memory ends.
  [[nodiscard]] bool factor(const BlockMatrix& matrix);
  /// x = A^-1 b with the last matrix factored.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile::unfolding
