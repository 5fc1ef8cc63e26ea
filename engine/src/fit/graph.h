// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::fitting {

/// Nodes spread over a shape, each with the vertices that follow it: what is moved in place of the
/// vertices as long as the form is coarse.
struct Graph {
  static constexpr std::size_t kPerVertex = 5;
  struct Share {
    std::uint32_t node = 0;
    double weight = 0;
  };
  std::vector<std::uint32_t> vertexOfNode;
  std::vector<std::array<Share, kPerVertex>> ofVertex;  ///< weights sum to 1; unused ones are 0
  struct Edge {
    std::uint32_t a = 0, b = 0;  ///< a < b: nodes that share vertices
    double length = 0;           ///< mm, at rest
  };
  std::vector<Edge> edges;
};

/// Farthest-point nodes in the distance along edges; every vertex hangs on its five nearest.
[[nodiscard]] Graph makeGraph(const Mesh& connectivity,
                              const std::vector<Eigen::Vector3d>& positions, std::size_t nodes);

}  // namespace toile::fitting
