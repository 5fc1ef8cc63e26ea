// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace toile::fitting {

/// Nearest points of a fixed set, by nanoflann. Queries are const and may run on several threads;
/// of points that are equally near it is always the same one that is told.
class KdTree {
 public:
  explicit KdTree(const std::vector<Eigen::Vector3d>& points);
  ~KdTree();
  KdTree(KdTree&& other) noexcept;
  KdTree& operator=(KdTree&& other) noexcept;

  struct Neighbour {
    std::uint32_t point = 0;
    double squaredDistance = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] Neighbour nearest(const Eigen::Vector3d& to) const;
  /// The `count` nearest, nearest first; fewer when there are fewer.
  void nearest(const Eigen::Vector3d& to, std::size_t count, std::vector<Neighbour>& found) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace toile::fitting
