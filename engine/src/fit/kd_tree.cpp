// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/kd_tree.h"

#include <numeric>

namespace toile::fitting {

KdTree::KdTree(const std::vector<Eigen::Vector3d>& points) : number_(points.size()) {
  std::iota(number_.begin(), number_.end(), 0U);
  points_ = points;
  nodes_.reserve(points.size() / 2 + 1);
  if (!points.empty()) build(0, static_cast<std::uint32_t>(points.size()));
  for (std::size_t i = 0; i < number_.size(); ++i) points_[i] = points[number_[i]];
}

void KdTree::build(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kLeafPoints = 8;
  const std::size_t at = nodes_.size();
  nodes_.push_back({0, begin, end, 0, 0});
  if (end - begin <= kLeafPoints) return;
  Eigen::Vector3d low = points_[number_[begin]];
  Eigen::Vector3d high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    low = low.cwiseMin(points_[number_[i]]);
    high = high.cwiseMax(points_[number_[i]]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto first = number_.begin();
  std::nth_element(first + begin, first + middle, first + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = points_[a][axis];
                     const double y = points_[b][axis];
                     return x != y ? x < y : a < b;
                   });
  nodes_[at].split = points_[number_[middle]][axis];
  nodes_[at].axis = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

template <class Visit>
void KdTree::visitNear(const Eigen::Vector3d& to, const Visit& visit) const {
  struct Waiting {
    std::uint32_t node;
    double distance;         // squared, to the node's half space
    Eigen::Vector3d offset;  // per axis
  };
  std::array<Waiting, 64> stack;
  std::size_t size = 0;
  double best = std::numeric_limits<double>::infinity();
  stack[size++] = {0, 0, Eigen::Vector3d::Zero()};
  while (size > 0) {
    Waiting at = stack[--size];
    if (at.distance > best) continue;
    while (nodes_[at.node].right != 0) {
      const Node& node = nodes_[at.node];
      const double beside = to[node.axis] - node.split;
      const std::uint32_t near = beside < 0 ? at.node + 1 : node.right;
      const std::uint32_t far = beside < 0 ? node.right : at.node + 1;
      Waiting other{far, 0, at.offset};
      other.offset[node.axis] = beside;
      other.distance = other.offset.squaredNorm();
      if (other.distance <= best) stack[size++] = other;
      at.node = near;
    }
    const Node& leaf = nodes_[at.node];
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) best = visit(i);
  }
}

KdTree::Neighbour KdTree::nearest(const Eigen::Vector3d& to) const {
  Neighbour best;
  if (nodes_.empty()) return best;
  visitNear(to, [&](std::uint32_t i) {
    const double distance = (points_[i] - to).squaredNorm();
    if (distance < best.squaredDistance ||
        (distance == best.squaredDistance && number_[i] < best.point)) {
      best = {number_[i], distance};
    }
    return best.squaredDistance;
  });
  return best;
}

void KdTree::nearest(const Eigen::Vector3d& to, std::size_t count,
                     std::vector<Neighbour>& found) const {
  found.clear();
  if (nodes_.empty() || count == 0) return;
  const auto isNearer = [](const Neighbour& a, const Neighbour& b) {
    return a.squaredDistance != b.squaredDistance ? a.squaredDistance < b.squaredDistance
                                                  : a.point < b.point;
  };
  visitNear(to, [&](std::uint32_t i) {
    const Neighbour one{number_[i], (points_[i] - to).squaredNorm()};
    if (found.size() < count || isNearer(one, found.back())) {
      if (found.size() == count) found.pop_back();
      found.insert(std::upper_bound(found.begin(), found.end(), one, isNearer), one);
    }
    return found.size() < count ? std::numeric_limits<double>::infinity()
                                : found.back().squaredDistance;
  });
}

}  // namespace toile::fitting
