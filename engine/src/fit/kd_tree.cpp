// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/kd_tree.h"

#include <algorithm>
#include <nanoflann.hpp>

namespace toile::fitting {
namespace {

constexpr std::size_t kLeafPoints = 20;

/// The points as nanoflann asks for them.
struct Points {
  std::vector<Eigen::Vector3d> places;
  // NOLINTBEGIN(readability-identifier-naming): nanoflann's names
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return places.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return places[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // it finds it itself
  }
  // NOLINTEND(readability-identifier-naming)
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>,
                                                 Points, 3, std::uint32_t>;

}  // namespace

struct KdTree::Index {
  explicit Index(const std::vector<Eigen::Vector3d>& places)
      : points{places}, tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafPoints)) {}
  Points points;
  Tree tree;  // built by its constructor, which keeps a reference to the points
};

KdTree::KdTree(const std::vector<Eigen::Vector3d>& points)
    : index_(std::make_unique<const Index>(points)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&& other) noexcept = default;
KdTree& KdTree::operator=(KdTree&& other) noexcept = default;

KdTree::Neighbour KdTree::nearest(const Eigen::Vector3d& to) const {
  Neighbour best;
  index_->tree.knnSearch(to.data(), 1, &best.point, &best.squaredDistance);
  return best;
}

void KdTree::nearest(const Eigen::Vector3d& to, std::size_t count,
                     std::vector<Neighbour>& found) const {
  std::vector<std::uint32_t> numbers(count);
  std::vector<double> distances(count);
  const std::size_t n = index_->tree.knnSearch(to.data(), count, numbers.data(), distances.data());
  found.clear();
  for (std::size_t i = 0; i < n; ++i) found.push_back({numbers[i], distances[i]});
}

}  // namespace toile::fitting
