// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "unfold/block_matrix.h"
#include "unfold/elimination.h"

namespace toile::unfolding {

/// Multifrontal Cholesky factor L L^T of matrices on one pattern: ordered and analysed once,
/// factored as often as wanted. One thread; the same bits in every run and on every processor.
/// @tparam kPerNode rows and columns of a node: 2 for the plane, 1 for a function on its vertices.
/// @see Liu, "The Multifrontal Method for Sparse Matrix Solution", SIAM Review 34(1), 1992.
template <std::size_t kPerNode>
class MultifrontalFactor {
 public:
  explicit MultifrontalFactor(const BlockPattern& pattern)
      : MultifrontalFactor(pattern, std::make_shared<const Elimination>(pattern)) {}
  /// @param elimination of the pattern, for factors that share it.
  MultifrontalFactor(const BlockPattern& pattern, std::shared_ptr<const Elimination> elimination);

  [[nodiscard]] const std::shared_ptr<const Elimination>& elimination() const {
    return elimination_;
  }

  /// False if the matrix is not positive definite; solve() may not be called then.
  /// @param values the upper triangle in compressed columns, the diagonal last in each.
  [[nodiscard]] bool factor(const std::vector<double>& values);
  [[nodiscard]] bool factor(const BlockMatrix& matrix) { return factor(matrix.values()); }
  /// x = A^-1 b with the last matrix factored.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

  /// Numbers that the factor holds.
  [[nodiscard]] std::size_t size() const { return panelStart_.back(); }

 private:
  std::shared_ptr<const Elimination> elimination_;
  std::vector<std::size_t> panelStart_;  ///< of each supernode, column-major, in panels_
  /// The numbers of the matrix that a supernode takes, and where in its panel they go.
  std::vector<std::size_t> moveStart_;
  std::vector<int> moveFrom_;
  std::vector<std::uint32_t> moveTo_;
  // Large, so made by the first factor() and left as they are until written.
  std::unique_ptr<double[]> panels_;
  std::unique_ptr<double[]> stack_;  ///< updates that wait for their parents
  std::size_t stackSize_ = 0;
  std::vector<std::size_t> waiting_;  ///< whose they are
  std::vector<double> front_, packed_, x_;
};

using SparseFactor = MultifrontalFactor<2>;
using ScalarFactor = MultifrontalFactor<1>;

}  // namespace toile::unfolding
