// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/kd_tree.h"
#include "toile/fit/scan.h"

namespace toile::fitting {

/// A scan made ready: what every step asks of its points.
struct Target {
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;       ///< none for clouds
  std::vector<Eigen::Vector3d> normals;  ///< unit, outwards once placed; zero where there is none
  std::vector<double> area;              ///< mm2 that a point stands for
  std::vector<char> isBorder;            ///< at the edge of a hole
  bool isCloud = false;
  double diagonal = 0;  ///< mm, of the box
  KdTree tree;
};

/// Normals, areas and borders. Of a cloud: from the 16 nearest points; neighbours' normals are made
/// to agree along a minimum spanning tree of their angles, as a whole they may point inwards.
/// @see Hoppe, DeRose, Duchamp, McDonald and Stuetzle, "Surface Reconstruction from Unorganized
///   Points", SIGGRAPH 1992.
[[nodiscard]] Target makeTarget(const Scan& scan);

}  // namespace toile::fitting
