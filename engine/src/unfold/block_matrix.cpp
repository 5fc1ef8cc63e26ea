// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/block_matrix.h"

#include <algorithm>

#include "toile/core/assert.h"

namespace toile::unfolding {

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
  row_.reserve(4 * nodeRow_.size() + 3 * nodeCount);
  for (std::size_t n = 0; n < nodeCount; ++n) {
    const int x = static_cast<int>(2 * n);
    for (int column = 0; column < 2; ++column) {
      for (int k = nodeStart_[n]; k < nodeStart_[n + 1]; ++k) {
        row_.push_back(2 * nodeRow_[static_cast<std::size_t>(k)]);
        row_.push_back(2 * nodeRow_[static_cast<std::size_t>(k)] + 1);
      }
      row_.push_back(x);
      if (column == 1) row_.push_back(x + 1);
      columnStart_[2 * n + static_cast<std::size_t>(column) + 1] = static_cast<int>(row_.size());
    }
  }
}

BlockPattern::Place BlockPattern::find(std::uint32_t i, std::uint32_t j) const {
  const bool transposed = i > j;
  if (transposed) std::swap(i, j);
  const auto begin = nodeRow_.begin() + nodeStart_[j];
  const auto end = nodeRow_.begin() + nodeStart_[j + 1];
  const auto found = std::lower_bound(begin, end, static_cast<int>(i));
  TOILE_ASSERT(found != end && *found == static_cast<int>(i));
  const int offset = 2 * static_cast<int>(found - begin);
  return {columnStart_[2 * j] + offset, columnStart_[2 * j + 1] + offset, transposed};
}

}  // namespace toile::unfolding
