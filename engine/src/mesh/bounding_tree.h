// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::detail {

/// A binary tree of boxes over the faces of a mesh. Only traversal: what happens in a leaf is the
/// caller's. Boxes are a little larger than the faces, so that rounding never loses one.
class BoundingTree {
 public:
  explicit BoundingTree(const Mesh& mesh);

  /// Visits faces near `to`, nearest boxes first, as long as a box is not farther away than what
  /// visit(face) returns: the squared distance of the best so far.
  template <class Visit>
  void visitNear(const Eigen::Vector3d& to, const Visit& visit) const;

  /// Visits the faces whose boxes the ray origin + t direction, t >= 0, meets, in any order.
  template <class Visit>
  void visitAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                  const Visit& visit) const;

 private:
  struct Node {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    std::uint32_t first = 0;  // of a leaf: its first face; else: the right child (left follows)
    std::uint32_t count = 0;  // faces of a leaf, else 0
  };
  struct Build;
  static constexpr std::size_t kMaxDepth = 64;  // median split: 2^64 leaves

  [[nodiscard]] double squaredDistance(const Node& node, const Eigen::Vector3d& p) const {
    return (node.low - p).cwiseMax(p - node.high).cwiseMax(0.0).squaredNorm();
  }

  std::vector<Node> nodes_;  // the root first
  std::vector<FaceId> faces_;
};

template <class Visit>
void BoundingTree::visitNear(const Eigen::Vector3d& to, const Visit& visit) const {
  struct Waiting {
    std::uint32_t node;
    double distance;
  };
  std::array<Waiting, kMaxDepth + 1> stack;
  std::size_t size = 0;
  double best = std::numeric_limits<double>::infinity();
  stack[size++] = {0, squaredDistance(nodes_[0], to)};
  while (size > 0) {
    const Waiting top = stack[--size];
    if (top.distance > best) continue;
    const Node& node = nodes_[top.node];
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) best = visit(faces_[node.first + i]);
      continue;
    }
    Waiting near{top.node + 1, squaredDistance(nodes_[top.node + 1], to)};
    Waiting far{node.first, squaredDistance(nodes_[node.first], to)};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance <= best) stack[size++] = far;
    if (near.distance <= best) stack[size++] = near;
  }
}

template <class Visit>
void BoundingTree::visitAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              const Visit& visit) const {
  const Eigen::Vector3d inverse = direction.cwiseInverse();
  const auto meets = [&](const Node& node) {
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        if (origin[axis] < node.low[axis] || origin[axis] > node.high[axis]) return false;
        continue;
      }
      const double a = (node.low[axis] - origin[axis]) * inverse[axis];
      const double b = (node.high[axis] - origin[axis]) * inverse[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    // A few roundings' worth of mercy; the leaf decides.
    return enter <= leave * (1 + 1e-14);
  };
  std::array<std::uint32_t, kMaxDepth + 1> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!meets(node)) continue;
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) visit(faces_[node.first + i]);
      continue;
    }
    stack[size++] = node.first;
    stack[size++] = at + 1;
  }
}

}  // namespace toile::detail
