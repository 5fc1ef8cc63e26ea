// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "unfold/block_matrix.h"

namespace toile::test {

/// All numbers of a block matrix, both halves.
inline Eigen::MatrixXd dense(const unfolding::BlockMatrix& matrix) {
  const unfolding::BlockPattern& pattern = matrix.pattern();
  const auto n = 2 * static_cast<Eigen::Index>(pattern.nodeCount());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  auto value = matrix.values().begin();
  for (Eigen::Index column = 0; column < n; ++column) {
    const auto node = static_cast<std::size_t>(column / 2);
    const auto set = [&](Eigen::Index row) { full(row, column) = full(column, row) = *value++; };
    for (int k = pattern.nodeStart()[node]; k < pattern.nodeStart()[node + 1]; ++k) {
      const Eigen::Index row = 2 * Eigen::Index{pattern.nodeRow()[static_cast<std::size_t>(k)]};
      set(row);
      set(row + 1);
    }
    for (Eigen::Index row = column - column % 2; row <= column; ++row) set(row);
  }
  return full;
}

}  // namespace toile::test
