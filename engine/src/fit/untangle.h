// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::fitting {

/// How the shape should be locally, as its surroundings turn and stretch it.
struct Expectation {
  std::vector<Eigen::Vector3d> shape;    ///< untangled, of every vertex; anywhere
  std::vector<Eigen::Matrix3d> linear;   ///< per vertex: what the surroundings do to it
  std::vector<Eigen::Vector3d> normals;  ///< per face, unit
};

/// Faces whose normal has at most that cosine with the expected one: 0 = points against it.
[[nodiscard]] std::vector<FaceId> turnedFaces(const Mesh& connectivity,
                                              const std::vector<Eigen::Vector3d>& positions,
                                              const Expectation& expected, double leastCosine = 0);

/// Lays the surroundings of turned faces out anew, as much like the expected shape as their
/// unchanged border lets them; a few rings more each time that this does not help.
void untangle(const Mesh& connectivity, const Expectation& expected,
              std::vector<Eigen::Vector3d>& positions);

/// Lays the surroundings of faces that cross out anew, each patch under one linear map, in which
/// the expected shape does not cross itself; a patch that is no better then keeps its form. Toes
/// and fingers are what mostly crosses.
void uncross(const Mesh& connectivity, const Expectation& expected,
             std::vector<Eigen::Vector3d>& positions);

}  // namespace toile::fitting
