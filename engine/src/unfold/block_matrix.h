// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace toile::unfolding {

/// Vertices that are mirror images of each other in x = 0 share a node of the matrix, with the sign
/// of x turned; those on the axis have no x. Without ties every vertex is its own node.
struct MirrorTies {
  std::vector<std::uint32_t> node;   ///< per vertex
  std::vector<std::int8_t> xFactor;  ///< per vertex: x = factor * x of the node; 0 on the axis
  std::size_t nodeCount = 0;
  [[nodiscard]] bool empty() const { return node.empty(); }

  /// Of a vector per vertex: what it is worth for the nodes.
  [[nodiscard]] Eigen::VectorXd reduce(const Eigen::VectorXd& full) const;
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::VectorXd& reduced) const;
};

/// Which nodes of the plane are coupled. Stored as the upper triangle of a matrix of 2x2 blocks,
/// in compressed columns of plain numbers as sparse solvers want them.
class BlockPattern {
 public:
  /// @param pairs of different nodes, in any order, repeated or not.
  BlockPattern(std::size_t nodeCount,
               const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);
  /// @param pairs of vertices.
  BlockPattern(MirrorTies ties, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

  [[nodiscard]] const MirrorTies& ties() const { return ties_; }

  [[nodiscard]] std::size_t nodeCount() const { return nodeStart_.size() - 1; }
  /// Upper neighbours of the nodes: those of smaller index, ascending.
  [[nodiscard]] const std::vector<int>& nodeStart() const { return nodeStart_; }
  [[nodiscard]] const std::vector<int>& nodeRow() const { return nodeRow_; }
  /// Where the columns of numbers begin, 2 per node: those of the upper neighbours, then its own.
  [[nodiscard]] const std::vector<int>& columnStart() const { return columnStart_; }

  /// Where the first column of a block of two nodes lies, and the second; `transposed` if the
  /// caller's first node is the larger.
  struct Place {
    int first = 0, second = 0;
    bool transposed = false;
    bool isPlain = true;      ///< neither vertex is tied
    bool isDiagonal = false;  ///< both are the same node, `first`
    std::int8_t xRow = 1, xColumn = 1;
  };
  [[nodiscard]] Place find(std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] int diagonal(std::uint32_t node) const { return columnStart_[2 * node + 1] - 1; }

 private:
  MirrorTies ties_;
  std::vector<int> nodeStart_, nodeRow_, columnStart_;
};

/// Numbers on a BlockPattern; symmetric.
class BlockMatrix {
 public:
  explicit BlockMatrix(const BlockPattern& pattern)
      : pattern_(&pattern), values_(static_cast<std::size_t>(pattern.columnStart().back()), 0.0) {}

  [[nodiscard]] const BlockPattern& pattern() const { return *pattern_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  void setZero() { std::fill(values_.begin(), values_.end(), 0.0); }

  /// Adds [xx xy; xy yy] to the block of a node with itself.
  void addDiagonal(std::uint32_t vertex, double xx, double xy, double yy) {
    const MirrorTies& ties = pattern_->ties();
    if (ties.empty()) return addToNode(vertex, xx, xy, yy);
    const double factor = ties.xFactor[vertex];
    addToNode(ties.node[vertex], factor * factor * xx, factor * xy, yy);
  }
  void addToNode(std::uint32_t node, double xx, double xy, double yy) {
    const auto xxPlace = static_cast<std::size_t>(pattern_->diagonal(node));
    const auto yyPlace = static_cast<std::size_t>(pattern_->columnStart()[2 * node + 2] - 1);
    values_[xxPlace] += xx;
    values_[yyPlace - 1] += xy;
    values_[yyPlace] += yy;
  }
  /// Adds a block whose row is the first node given to BlockPattern::find, its column the second.
  void add(const BlockPattern::Place& place, const Eigen::Matrix2d& block) {
    if (place.isPlain) return addPlain(place, block);
    Eigen::Matrix2d turned = block;
    turned.row(0) *= place.xRow;
    turned.col(0) *= place.xColumn;
    if (!place.isDiagonal) return addPlain(place, turned);
    addToNode(static_cast<std::uint32_t>(place.first), 2 * turned(0, 0),
              turned(0, 1) + turned(1, 0), 2 * turned(1, 1));
  }
  /// What an axis vertex has for x, so that the matrix stays definite.
  void fillAxis() {
    const MirrorTies& ties = pattern_->ties();
    for (std::size_t v = 0; v < ties.node.size(); ++v) {
      if (ties.xFactor[v] == 0) addToNode(ties.node[v], 1, 0, 0);
    }
  }

 private:
  void addPlain(const BlockPattern::Place& place, const Eigen::Matrix2d& block) {
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

  const BlockPattern* pattern_;
  std::vector<double> values_;
};

}  // namespace toile::unfolding
