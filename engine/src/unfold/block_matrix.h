// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace toile::unfolding {

/// Which nodes of the plane are coupled. Stored as the upper triangle of a matrix of 2x2 blocks,
/// in compressed columns of plain numbers as sparse solvers want them.
class BlockPattern {
 public:
  /// @param pairs of different nodes, in any order, repeated or not.
  BlockPattern(std::size_t nodeCount,
               const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

  [[nodiscard]] std::size_t nodeCount() const { return nodeStart_.size() - 1; }
  /// Upper neighbours of the nodes: those of smaller index, ascending.
  [[nodiscard]] const std::vector<int>& nodeStart() const { return nodeStart_; }
  [[nodiscard]] const std::vector<int>& nodeRow() const { return nodeRow_; }
  /// Columns and rows of the numbers, 2 per node.
  [[nodiscard]] const std::vector<int>& columnStart() const { return columnStart_; }
  [[nodiscard]] const std::vector<int>& row() const { return row_; }

  /// Where the first column of a block of two nodes lies, and the second; `transposed` if the
  /// caller's first node is the larger.
  struct Place {
    int first = 0, second = 0;
    bool transposed = false;
  };
  [[nodiscard]] Place find(std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] int diagonal(std::uint32_t node) const { return columnStart_[2 * node + 1] - 1; }

 private:
  std::vector<int> nodeStart_, nodeRow_, columnStart_, row_;
};

/// Numbers on a BlockPattern; symmetric.
class BlockMatrix {
 public:
  explicit BlockMatrix(const BlockPattern& pattern)
      : pattern_(&pattern), values_(pattern.row().size(), 0.0) {}

  [[nodiscard]] const BlockPattern& pattern() const { return *pattern_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  void setZero() { std::fill(values_.begin(), values_.end(), 0.0); }

  /// Adds [xx xy; xy yy] to the block of a node with itself.
  void addDiagonal(std::uint32_t node, double xx, double xy, double yy) {
    const auto xxPlace = static_cast<std::size_t>(pattern_->diagonal(node));
    const auto yyPlace = static_cast<std::size_t>(pattern_->columnStart()[2 * node + 2] - 1);
    values_[xxPlace] += xx;
    values_[yyPlace - 1] += xy;
    values_[yyPlace] += yy;
  }
  /// Adds a block whose row is the first node given to BlockPattern::find, its column the second.
  void add(const BlockPattern::Place& place, const Eigen::Matrix2d& block) {
    double* first = values_.data() + place.first;
    double* second = values_.data() + place.second;
    first[0] += block(0, 0);
    second[1] += block(1, 1);
    if (place.transposed) {
      first[1] += block(0, 1);
      second[0] += block(1, 0);
    } else {
      first[1] += block(1, 0);
      second[0] += block(0, 1);
    }
  }

 private:
  const BlockPattern* pattern_;
  std::vector<double> values_;
};

}  // namespace toile::unfolding
