// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cut/node_table.h"

namespace toile::cutting {

/// Whose a segment is. Where curves share one, the least owner keeps it: the strongest kind (seam
/// before opening, dart, elastic, feature), then the curve that comes first in the design; a curve
/// that runs there and back counts as running along the nodes' order.
struct Owner {
  std::uint8_t rank = 0;
  std::uint32_t curve = 0;
  bool backward = false;  ///< the curve runs from b to a
  friend auto operator<=>(const Owner&, const Owner&) = default;
};

/// A straight part of a curve between two nodes, a < b, inside a face or along an edge.
struct Segment {
  Node a;
  Node b;
  Owner owner;
  friend auto operator<=>(const Segment&, const Segment&) = default;
};

/// From the nodes in the curve's direction.
[[nodiscard]] Segment makeSegment(const Node& from, const Node& to, std::uint8_t rank,
                                  std::uint32_t curve);

/// Sorts segments and leaves one of those between equal nodes: the least owner's. Drops those
/// without length.
void mergeSegments(std::vector<Segment>& segments);

/// Makes the segments of one face meet at nodes only, by iterated snap rounding: a segment that
/// passes closer than half the tolerance to a node is led through it, crossing ones get a node,
/// until nothing changes. Half of the distance that nodes keep, so that parts are shorter than the
/// whole and the work ends.
///
/// @param segments  of the face; those that come to lie along a side are moved to `alongEdges`.
/// @return false if they do not come to rest (never seen but for faces without area).
/// @see Halperin and Packer, "Iterated snap rounding", Computational Geometry 23(2), 2002.
bool settleSegments(const FaceFrame& frame, NodeTable& table, std::vector<Segment>& segments,
                    std::vector<Segment>& alongEdges, double tolerance);

}  // namespace toile::cutting
