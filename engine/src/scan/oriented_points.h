// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/fit/scan.h"

namespace toile::scanning {

/// Evenly spread points of a surface with the directions of its outside.
struct OrientedPoints {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< unit
  double spacing = 0;                    ///< mm, between neighbours
};

/// The scan with one point for each cube of side `spacing` and each direction of the surface in it:
/// the mean of what was measured there, faces by area. Two sheets that face apart stay two.
///
/// @param normals of the scan's points, unit; zero where there is none (that point is left out)
[[nodiscard]] OrientedPoints spreadEvenly(const Scan& scan,
                                          const std::vector<Eigen::Vector3d>& normals,
                                          double spacing);

/// The integer cube of side `size` that a point lies in.
[[nodiscard]] inline Eigen::Vector3i cubeOf(const Eigen::Vector3d& p, double size) {
  return (p / size).array().floor().cast<int>();
}

struct CubeHash {
  std::size_t operator()(const Eigen::Vector3i& c) const {
    return std::size_t(c.x()) * 73856093U ^ std::size_t(c.y()) * 19349663U ^
           std::size_t(c.z()) * 83492791U;
  }
};

}  // namespace toile::scanning
