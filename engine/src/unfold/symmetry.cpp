// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/symmetry.h"

#include <cmath>

#include "unfold/least_strain.h"
#include "unfold/start.h"

namespace toile::unfolding {

void makeSymmetric(const PieceSymmetry& symmetry, Plane& q) {
  // A pair's difference is across the axis, the sum of two vertices and their images along it.
  Eigen::Vector2d across = Eigen::Vector2d::Zero();
  for (const auto& [right, left] : symmetry.pairs) {
    across += at(q, static_cast<std::uint32_t>(right.index())) -
              at(q, static_cast<std::uint32_t>(left.index()));
  }
  across.normalize();
  for (Eigen::Index i = 0; i < q.size(); i += 2) {
    const Eigen::Vector2d p = q.segment<2>(i);
    q.segment<2>(i) = Eigen::Vector2d(across.dot(p), across.x() * p.y() - across.y() * p.x());
  }
  double middle = 0;
  for (const auto& [right, left] : symmetry.pairs) {
    middle += 0.5 * (q[2 * static_cast<Eigen::Index>(right.index())] +
                     q[2 * static_cast<Eigen::Index>(left.index())]);
  }
  middle /= static_cast<double>(symmetry.pairs.size());
  for (Eigen::Index i = 0; i < q.size(); i += 2) q[i] -= middle;
  for (const auto& [right, left] : symmetry.pairs) {
    const auto r = 2 * static_cast<Eigen::Index>(right.index());
    const auto l = 2 * static_cast<Eigen::Index>(left.index());
    const double x = 0.5 * (q[r] - q[l]);
    const double y = 0.5 * (q[r + 1] + q[l + 1]);
    q[r] = x;
    q[l] = -x;
    q[r + 1] = q[l + 1] = y;
  }
  for (const VertexId v : symmetry.axis) q[2 * static_cast<Eigen::Index>(v.index())] = 0;
}

MirrorTies tiesOf(const PieceSymmetry& symmetry, std::size_t vertexCount) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  MirrorTies ties;
  ties.node.assign(vertexCount, kNone);
  ties.xFactor.assign(vertexCount, 1);
  for (const VertexId v : symmetry.axis) ties.xFactor[v.index()] = 0;
  std::vector<std::uint32_t> image(vertexCount, kNone);
  for (const auto& [right, left] : symmetry.pairs) {
    image[left.index()] = static_cast<std::uint32_t>(right.index());
    ties.xFactor[left.index()] = -1;
  }
  for (std::size_t v = 0; v < vertexCount; ++v) {
    if (image[v] == kNone) ties.node[v] = static_cast<std::uint32_t>(ties.nodeCount++);
  }
  for (std::size_t v = 0; v < vertexCount; ++v) {
    if (image[v] != kNone) ties.node[v] = ties.node[image[v]];
  }
  return ties;
}

Result<Plane> symmetricStart(const Problem& problem, const std::vector<Eigen::Vector3d>& positions,
                             const PieceSymmetry& symmetry, const BlockPattern& pattern,
                             SparseFactor& factor) {
  const auto axis = [&](std::size_t i) {
    return static_cast<std::uint32_t>(symmetry.axis[i].index());
  };
  // One number per vertex costs little; with the pairs tied it would have two.
  const BlockPattern free = couplingsOf(problem);
  std::optional<Plane> start =
      boundaryFirstStart(problem, free, std::make_shared<const Elimination>(free));
  if (start) makeSymmetric(symmetry, *start);
  if (!start || flippedCount(problem, *start) > 0) {
    start = conformalStart(problem, positions, {axis(0), axis(1)}, pattern, factor);
  }
  if (!start || flippedCount(problem, *start) > 0) {
    start = circleStart(problem);
    if (start) makeSymmetric(symmetry, *start);
  }
  if (!start || flippedCount(problem, *start) > 0) {
    return Error{ErrorCode::NotConverged,
                 "no symmetric placement without folded faces was found to begin with; unfold it "
                 "without symmetry",
                 {}};
  }
  return *std::move(start);
}

}  // namespace toile::unfolding
