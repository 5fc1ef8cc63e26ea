// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/edge_sides.h"

#include <algorithm>

namespace toile::detail {

std::vector<EdgeSide> sortedEdgeSides(const std::vector<Triangle>& triangles,
                                      std::size_t vertexCount) {
  // Counting sort by the tail; halfedges stay in order within a bucket.
  std::vector<std::size_t> begin(vertexCount + 1, 0);
  const auto tailOf = [](const Triangle& t, std::size_t k) {
    return std::min(t[k], t[(k + 1) % 3]).index();
  };
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++begin[tailOf(t, k) + 1];
  }
  for (std::size_t v = 0; v < vertexCount; ++v) begin[v + 1] += begin[v];
  std::vector<EdgeSide> sides(3 * triangles.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t tail = tailOf(triangles[f], k);
      const std::uint32_t head = std::max(triangles[f][k], triangles[f][(k + 1) % 3]).index();
      sides[next[tail]++] = {tail, head, static_cast<std::uint32_t>(3 * f + k)};
    }
  }
  for (std::size_t v = 0; v < vertexCount; ++v) {
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              sides.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]),
              [](const EdgeSide& a, const EdgeSide& b) {
                return a.head != b.head ? a.head < b.head : a.halfedge < b.halfedge;
              });
  }
  return sides;
}

}  // namespace toile::detail
