// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "cut/node.h"

namespace toile::cutting {

/// All nodes of a cut. Nodes of an edge, and those inside a face, keep at least the tolerance from
/// each other and from what bounds them: whoever comes closer becomes the node that is there.
/// (Two edges that meet at a very acute corner may carry nodes that are closer.)
class NodeTable {
 public:
  explicit NodeTable(const Mesh& mesh);

  /// Puts a node on an edge, t parts from its tail, or returns the one within the tolerance.
  Node insertOnEdge(EdgeId edge, std::int64_t t, double tolerance);
  /// Puts a node into a closed face, or returns the one within the tolerance; a place within the
  /// tolerance of a side goes onto that side.
  Node insertInFace(const FaceFrame& frame, LatticePoint at, double tolerance);

  /// Parts from the tail, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& onEdge(EdgeId e) const {
    return onEdge_[e.index()];
  }
  /// Weights of the second and third corner, ascending.
  [[nodiscard]] const std::vector<std::pair<std::uint32_t, std::uint32_t>>& inFace(FaceId f) const {
    return inFace_[f.index()];
  }
  /// Corners, nodes on the sides, nodes inside.
  [[nodiscard]] std::vector<Node> nodesOf(const FaceFrame& frame) const;
  /// Edges that got nodes since the last call, ascending, each once.
  std::vector<EdgeId> takeChangedEdges();

 private:
  /// Corners and nodes on the sides.
  [[nodiscard]] std::vector<Node> nodesAround(const FaceFrame& frame) const;

  const Mesh& mesh_;
  std::vector<std::vector<std::uint32_t>> onEdge_;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> inFace_;
  std::vector<EdgeId> changedEdges_;
};

}  // namespace toile::cutting
