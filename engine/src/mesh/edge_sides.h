// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::detail {

/// One side of an undirected edge of a triangle soup: halfedge 3f+k of face f, and the vertices.
struct EdgeSide {
  std::uint32_t tail = 0;  ///< smaller vertex
  std::uint32_t head = 0;
  std::uint32_t halfedge = 0;

  [[nodiscard]] std::uint32_t face() const { return halfedge / 3; }
};

/// All sides by (tail, head, halfedge): the sides of one edge stand together. O(n) but for the
/// sorting of each vertex's few edges. Precondition: indices below vertexCount.
[[nodiscard]] std::vector<EdgeSide> sortedEdgeSides(const std::vector<Triangle>& triangles,
                                                    std::size_t vertexCount);

/// Calls visit(std::span<const EdgeSide>) for every edge, in order.
template <class Visit>
void forEachEdge(const std::vector<EdgeSide>& sides, const Visit& visit) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].tail == sides[i].tail &&
           sides[end].head == sides[i].head) {
      ++end;
    }
    visit(std::span<const EdgeSide>(sides.data() + i, end - i));
    i = end;
  }
}

}  // namespace toile::detail
