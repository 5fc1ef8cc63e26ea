// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/bounding_tree.h"

#include <algorithm>

namespace toile::detail {

struct BoundingTree::Build {
  BoundingTree& tree;
  std::vector<Eigen::AlignedBox3d> boxes;  // per face
  double margin = 0;

  void split(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t kLeafFaces = 4;
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3d centres;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Eigen::AlignedBox3d& b = boxes[tree.faces_[i].index()];
      box.extend(b);
      centres.extend(b.center());
    }
    const std::size_t at = tree.nodes_.size();
    tree.nodes_.push_back({box.min().array() - margin, box.max().array() + margin, begin, 0});
    if (end - begin <= kLeafFaces) {
      tree.nodes_[at].count = end - begin;
      return;
    }
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto first = tree.faces_.begin();
    std::nth_element(first + begin, first + middle, first + end, [&](FaceId a, FaceId b) {
      const double x = boxes[a.index()].center()[axis];
      const double y = boxes[b.index()].center()[axis];
      return x != y ? x < y : a < b;
    });
    split(begin, middle);
    tree.nodes_[at].first = static_cast<std::uint32_t>(tree.nodes_.size());
    split(middle, end);
  }
};

BoundingTree::BoundingTree(const Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.faceCount());
  Build build{*this, {}, 0};
  build.boxes.reserve(count);
  faces_.reserve(count);
  for (std::uint32_t f = 0; f < count; ++f) {
    Eigen::AlignedBox3d& box = build.boxes.emplace_back();
    for (const VertexId v : mesh.vertices(FaceId(f))) box.extend(mesh.position(v));
    faces_.emplace_back(f);
  }
  const double largest =
      std::max(mesh.boxMin().cwiseAbs().maxCoeff(), mesh.boxMax().cwiseAbs().maxCoeff());
  build.margin = 1e-14 * largest;
  nodes_.reserve(count);
  build.split(0, count);
}

}  // namespace toile::detail
