// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace toile::fitting {

/// Nearest points of a fixed set. Queries are const and may run on several threads; of points that
/// are equally near the one of smallest number is told.
class KdTree {
 public:
  explicit KdTree(const std::vector<Eigen::Vector3d>& points);

  struct Neighbour {
    std::uint32_t point = 0;
    double squaredDistance = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] Neighbour nearest(const Eigen::Vector3d& to) const;
  /// The `count` nearest, nearest first; fewer when there are fewer.
  void nearest(const Eigen::Vector3d& to, std::size_t count, std::vector<Neighbour>& found) const;

 private:
  struct Node {
    double split = 0;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  ///< number of the right child; the left follows its parent; 0 = leaf
    std::uint8_t axis = 0;
  };
  void build(std::uint32_t begin, std::uint32_t end);
  /// visit(place in points_) -> squared distance beyond which nothing is wanted
  template <class Visit>
  void visitNear(const Eigen::Vector3d& to, const Visit& visit) const;

  std::vector<Node> nodes_;
  std::vector<Eigen::Vector3d> points_;  ///< in the order of the leaves
  std::vector<std::uint32_t> number_;    ///< of each of them
};

}  // namespace toile::fitting
