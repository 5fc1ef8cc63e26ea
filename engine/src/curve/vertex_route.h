// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "curve/face_geometry.h"
#include "toile/mesh/surface_point.h"

namespace toile::detail {

/// Appends the halfedges crossed when turning around a vertex from a face to the first of the
/// goals, the way round that passes less angle. Precondition: all of them are faces around the
/// vertex.
void appendTurn(const Mesh& mesh, FaceGeometry& geometry, VertexId vertex, FaceId from,
                std::span<const FaceId> goals, std::vector<HalfedgeId>& row);

/// Finds a first way between two surface points along mesh edges: the shortest one, by A* with the
/// straight distance as bound. Keeps its arrays between calls.
class VertexRoute {
 public:
  VertexRoute(const Mesh& mesh, FaceGeometry& geometry);

  /// @return the row of halfedges that a strip beside the way crosses (may lead back and forth);
  ///   nullopt when the points lie in different components.
  std::optional<std::vector<HalfedgeId>> find(const SurfacePoint& start, const SurfacePoint& end);

 private:
  struct Node {
    double cost = 0;  ///< from the start
    VertexId previous;
    std::uint32_t run = 0;  ///< of the call that wrote the entry
    bool isDone = false;
  };
  struct Candidate {
    double bound = 0;
    VertexId vertex;
  };

  std::vector<VertexId> findVertices(const SurfacePoint& start, const SurfacePoint& end);
  void offer(VertexId vertex, double cost, VertexId previous, const Eigen::Vector3d& goal);

  const Mesh& mesh_;
  FaceGeometry& geometry_;
  std::vector<Node> nodes_;
  std::vector<Candidate> heap_;
  std::uint32_t run_ = 0;
};

}  // namespace toile::detail
