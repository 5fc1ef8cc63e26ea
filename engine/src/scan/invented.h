// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scan/oriented_points.h"
#include "toile/mesh/mesh.h"
#include "toile/mesh/surface_point.h"

namespace toile::scanning {

/// A connected part of a surface that no points lie near.
struct Invented {
  double area = 0;         ///< mm2
  Eigen::Vector3d centre;  ///< mean, by area
  Eigen::Vector3d normal;  ///< mean, by area
  std::vector<SurfacePath> borders;
};

/// Largest first. What has gaps of less than a few spacings between its points is none.
[[nodiscard]] std::vector<Invented> findInvented(const Mesh& mesh, const OrientedPoints& points);

}  // namespace toile::scanning
