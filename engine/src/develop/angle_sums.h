// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::developing {

using Positions = std::vector<Eigen::Vector3d>;

/// Unit normals of the vertices, weighted by the areas of their faces.
[[nodiscard]] Positions vertexNormals(const Mesh& mesh, const Positions& at);

/// The vertices of a mesh that are not held, numbered in their order.
struct FreeVertices {
  explicit FreeVertices(const Mesh& mesh);  ///< the border is held
  FreeVertices(const Mesh& mesh, const VertexData<char>& isHeld);
  std::vector<VertexId> vertices;
  VertexData<std::int32_t> number;  ///< -1 where held
  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(vertices.size()); }
};

/// 2 pi - the sum of the angles at each free vertex.
[[nodiscard]] Eigen::VectorXd defects(const Mesh& mesh, const FreeVertices& inner,
                                      const Positions& at);

/// How the angle sums change when each free vertex moves along its direction: row = vertex whose
/// angles are summed, column = vertex that moves; radians per mm.
[[nodiscard]] Eigen::SparseMatrix<double> angleSumGradient(const Mesh& mesh,
                                                           const FreeVertices& inner,
                                                           const Positions& at,
                                                           const Positions& direction);

/// Root mean square angle between neighbour faces, radians.
[[nodiscard]] double roughness(const Mesh& mesh, const Positions& at);

}  // namespace toile::developing
