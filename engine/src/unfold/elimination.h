// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "unfold/block_matrix.h"

namespace toile::unfolding {

/// Nodes that are eliminated together: their columns of the factor have the same rows below.
struct Supernode {
  int first = 0, end = 0;        ///< its pivots, in elimination order
  std::vector<int> rows;         ///< nodes below that its columns reach, ascending
  int parent = -1;               ///< the supernode of rows.front()
  std::vector<int> rowsInPanel;  ///< where `rows` stand among pivots and rows of the parent
  [[nodiscard]] int pivots() const { return end - first; }
  [[nodiscard]] int below() const { return static_cast<int>(rows.size()); }
};

/// In which order the nodes of a symmetric matrix are eliminated, and what its Cholesky factor then
/// looks like. Children come before parents, and the children of one parent one after the other, so
/// that their updates can lie on a stack.
struct Elimination {
  std::vector<int> placeOfNode;  ///< node -> place in the order
  std::vector<Supernode> supernodes;

  /// Approximate minimum degree, then supernodes that may hold a few zeros for being larger.
  /// @see Amestoy, Davis and Duff, "An Approximate Minimum Degree Ordering Algorithm", SIAM J.
  ///   Matrix Anal. Appl. 17(4), 1996; Liu, "The Multifrontal Method for Sparse Matrix Solution",
  ///   SIAM Review 34(1), 1992.
  explicit Elimination(const BlockPattern& pattern);
};

}  // namespace toile::unfolding
