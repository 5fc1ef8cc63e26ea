// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/block_matrix.h"

#include <algorithm>

#include "toile/core/assert.h"

namespace toile::unfolding {

namespace {

std::vector<std::pair<std::uint32_t, std::uint32_t>> nodePairs(
    const MirrorTies& ties, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> nodes;
  nodes.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    if (ties.node[i] != ties.node[j]) nodes.emplace_back(ties.node[i], ties.node[j]);
  }
  return nodes;
}

}  // namespace

Eigen::VectorXd MirrorTies::reduce(const Eigen::VectorXd& full) const {
  if (empty()) return full;
  Eigen::VectorXd reduced = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(nodeCount));
  for (std::size_t v = 0; v < node.size(); ++v) {
    reduced[2 * Eigen::Index{node[v]}] += xFactor[v] * full[static_cast<Eigen::Index>(2 * v)];
    reduced[2 * Eigen::Index{node[v]} + 1] += full[static_cast<Eigen::Index>(2 * v + 1)];
  }
  return reduced;
}

Eigen::VectorXd MirrorTies::expand(const Eigen::VectorXd& reduced) const {
  if (empty()) return reduced;
  Eigen::VectorXd full(2 * static_cast<Eigen::Index>(node.size()));
  for (std::size_t v = 0; v < node.size(); ++v) {
    full[static_cast<Eigen::Index>(2 * v)] = xFactor[v] * reduced[2 * Eigen::Index{node[v]}];
    full[static_cast<Eigen::Index>(2 * v + 1)] = reduced[2 * Eigen::Index{node[v]} + 1];
  }
  return full;
}

BlockPattern::BlockPattern(MirrorTies ties,
                           const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs)
    : BlockPattern(ties.nodeCount, nodePairs(ties, pairs)) {
  ties_ = std::move(ties);
}

BlockPattern::BlockPattern(std::size_t nodeCount,
                           const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs)
    : nodeStart_(nodeCount + 1, 0), columnStart_(2 * nodeCount + 1, 0) {
  // Sorted by counting into columns; each column is then short.
  std::vector<int> start(nodeCount + 1, 0);
  for (const auto& [i, j] : pairs) ++start[std::max(i, j) + 1];
  for (std::size_t n = 0; n < nodeCount; ++n) start[n + 1] += start[n];
  std::vector<int> rows(pairs.size());
  std::vector<int> fill(start.begin(), start.end() - 1);
  for (const auto& [i, j] : pairs) {
    rows[static_cast<std::size_t>(fill[std::max(i, j)]++)] = static_cast<int>(std::min(i, j));
  }
  nodeRow_.reserve(pairs.size() / 2 + nodeCount);
  for (std::size_t n = 0; n < nodeCount; ++n) {
    const auto begin = rows.begin() + start[n];
    const auto end = rows.begin() + start[n + 1];
    std::sort(begin, end);
    nodeRow_.insert(nodeRow_.end(), begin, std::unique(begin, end));
    nodeStart_[n + 1] = static_cast<int>(nodeRow_.size());
  }
  for (std::size_t n = 0; n < nodeCount; ++n) {
    const int above = 2 * (nodeStart_[n + 1] - nodeStart_[n]);
    columnStart_[2 * n + 1] = columnStart_[2 * n] + above + 1;
    columnStart_[2 * n + 2] = columnStart_[2 * n + 1] + above + 2;
  }
}

BlockPattern::Place BlockPattern::find(std::uint32_t i, std::uint32_t j) const {
  Place place;
  if (!ties_.empty()) {
    place.xRow = ties_.xFactor[i];
    place.xColumn = ties_.xFactor[j];
    i = ties_.node[i];
    j = ties_.node[j];
    place.isPlain = place.xRow == 1 && place.xColumn == 1 && i != j;
    place.isDiagonal = i == j;
    if (place.isDiagonal) {
      place.first = static_cast<int>(i);
      return place;
    }
  }
  const bool transposed = i > j;
  if (transposed) std::swap(i, j);
  const auto begin = nodeRow_.begin() + nodeStart_[j];
  const auto end = nodeRow_.begin() + nodeStart_[j + 1];
  const auto found = std::lower_bound(begin, end, static_cast<int>(i));
  TOILE_ASSERT(found != end && *found == static_cast<int>(i));
  const int offset = 2 * static_cast<int>(found - begin);
  place.first = columnStart_[2 * j] + offset;
  place.second = columnStart_[2 * j + 1] + offset;
  place.transposed = transposed;
  return place;
}

}  // namespace toile::unfolding
