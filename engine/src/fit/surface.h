// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::fitting {

/// What the steps ask of a shape on the template's connectivity.
struct Shape {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3d> normals;  ///< per vertex, unit, weighted by area
  std::vector<double> area;              ///< per vertex, a third of its faces
  double totalArea = 0;
};

[[nodiscard]] Shape makeShape(const std::vector<Triangle>& triangles,
                              std::vector<Eigen::Vector3d> positions);

[[nodiscard]] Eigen::Vector3d faceCross(const std::vector<Eigen::Vector3d>& positions,
                                        const Triangle& triangle);

/// The value below which that share of the values lies (0..1); 0 for none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace toile::fitting
