// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "toile/core/content_hash.h"
#include "toile/core/id.h"
#include "toile/core/result.h"

namespace toile {

using Triangle = std::array<VertexId, 3>;

/// An oriented 2-manifold triangle mesh, with or without border, of any genus and any number of
/// components. Immutable: every Mesh that exists has passed makeMesh().
///
/// Positions in mm, outside = counter-clockwise. Halfedge 3f+k runs from corner k of face f to
/// corner (k+1)%3 and has f on its left; there are no halfedges outside the border. An edge runs
/// from its vertex of smaller index (tail) to the one of larger index (head), whichever halfedges
/// it has. Every vertex is used by a face.
class Mesh {
 public:
  [[nodiscard]] std::size_t vertexCount() const { return positions_.size(); }
  [[nodiscard]] std::size_t edgeCount() const { return edgeHalfedge_.size(); }
  [[nodiscard]] std::size_t faceCount() const { return triangles_.size(); }
  [[nodiscard]] std::size_t halfedgeCount() const { return 3 * triangles_.size(); }

  [[nodiscard]] const Eigen::Vector3d& position(VertexId v) const { return positions_[v.index()]; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& positions() const { return positions_; }
  [[nodiscard]] const Triangle& vertices(FaceId f) const { return triangles_[f.index()]; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  [[nodiscard]] HalfedgeId halfedge(FaceId f, int side) const {
    return HalfedgeId(3 * std::size_t{f.index()} + static_cast<std::size_t>(side));
  }
  [[nodiscard]] FaceId face(HalfedgeId h) const { return FaceId(h.index() / 3); }
  [[nodiscard]] int side(HalfedgeId h) const { return static_cast<int>(h.index() % 3); }
  [[nodiscard]] HalfedgeId next(HalfedgeId h) const {
    return HalfedgeId(h.index() % 3 == 2 ? h.index() - 2 : h.index() + 1);
  }
  [[nodiscard]] HalfedgeId previous(HalfedgeId h) const {
    return HalfedgeId(h.index() % 3 == 0 ? h.index() + 2 : h.index() - 1);
  }
  /// The halfedge of the neighbour face; invalid at the border.
  [[nodiscard]] HalfedgeId opposite(HalfedgeId h) const { return opposite_[h.index()]; }
  [[nodiscard]] VertexId from(HalfedgeId h) const {
    return triangles_[h.index() / 3][h.index() % 3];
  }
  [[nodiscard]] VertexId to(HalfedgeId h) const { return from(next(h)); }
  [[nodiscard]] EdgeId edge(HalfedgeId h) const { return halfedgeEdge_[h.index()]; }
  /// One halfedge of the edge: the one from tail to head if it exists, otherwise the other.
  [[nodiscard]] HalfedgeId halfedge(EdgeId e) const { return edgeHalfedge_[e.index()]; }
  [[nodiscard]] VertexId tail(EdgeId e) const;  ///< vertex of smaller index
  [[nodiscard]] VertexId head(EdgeId e) const;  ///< vertex of larger index
  [[nodiscard]] bool isBorder(EdgeId e) const { return !opposite(halfedge(e)).isValid(); }
  /// A halfedge that leaves the vertex; at the border the first one counter-clockwise (no face on
  /// its right), so that turning by opposite(previous(h)) sweeps the whole fan.
  [[nodiscard]] HalfedgeId outgoing(VertexId v) const { return outgoing_[v.index()]; }
  [[nodiscard]] bool isBorder(VertexId v) const { return !opposite(outgoing(v)).isValid(); }
  /// Faces around the vertex, counter-clockwise from outgoing(v).
  [[nodiscard]] std::vector<FaceId> facesAround(VertexId v) const;
  /// The edge between two vertices; invalid id if there is none.
  [[nodiscard]] EdgeId findEdge(VertexId a, VertexId b) const;

  [[nodiscard]] double length(EdgeId e) const;
  [[nodiscard]] double area(FaceId f) const;
  [[nodiscard]] Eigen::Vector3d normal(FaceId f) const;  ///< unit; zero for a face without area
  [[nodiscard]] double meanEdgeLength() const { return meanEdgeLength_; }
  [[nodiscard]] const Eigen::Vector3d& boxMin() const { return boxMin_; }
  [[nodiscard]] const Eigen::Vector3d& boxMax() const { return boxMax_; }

  /// Loops of border halfedges, each in order with the surface on the left; loops by their
  /// smallest halfedge, which comes first.
  [[nodiscard]] std::vector<std::vector<HalfedgeId>> boundaryLoops() const;
  [[nodiscard]] std::size_t componentCount() const;
  /// V - E + F.
  [[nodiscard]] std::int64_t eulerCharacteristic() const;
  /// Of the triangles alone (not the positions): bodies on one connectivity share it.
  [[nodiscard]] const ContentHash& connectivityHash() const { return connectivityHash_; }

  /// The same connectivity in another shape. Precondition: as many positions as vertices.
  [[nodiscard]] Mesh withPositions(std::vector<Eigen::Vector3d> positions) const;

 private:
  friend Result<Mesh> makeMesh(std::vector<Eigen::Vector3d>, std::vector<Triangle>);
  Mesh() = default;
  void measure();

  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<HalfedgeId> opposite_;
  std::vector<EdgeId> halfedgeEdge_;
  std::vector<HalfedgeId> edgeHalfedge_;
  std::vector<HalfedgeId> outgoing_;
  Eigen::Vector3d boxMin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d boxMax_ = Eigen::Vector3d::Zero();
  double meanEdgeLength_ = 0;
  ContentHash connectivityHash_;
};

/// Builds the connectivity, keeping vertex and face order.
///
/// @param positions mm, finite; every one used by a triangle.
/// @param triangles three different vertices each, neighbours oriented alike.
/// @return the mesh, or an Error:
///   InvalidArgument  no face, index out of range, unused vertex, coordinate not finite
///   DegenerateFace   a triangle with a repeated vertex (zero area is allowed here)
///   NotManifold      `where` lists the edges' vertices or the vertices with several fans
///   NotOrientable    two neighbours run along their edge the same way (repairing an orientation is
///                    the reader's work, see mesh/mesh_repair.h)
/// @par Cost  O(n log n)
Result<Mesh> makeMesh(std::vector<Eigen::Vector3d> positions, std::vector<Triangle> triangles);

}  // namespace toile
