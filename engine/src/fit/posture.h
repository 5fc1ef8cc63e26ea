// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/placement.h"
#include "fit/segments.h"
#include "toile/mesh/mesh.h"

namespace toile::fitting {

struct Posed {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Matrix3d> linear;  ///< per vertex, from the shape before: rotation and scale
};

/// Brings a body's segments to where their landmarks are: each stiff part by its own similarity,
/// what lies between two laid out under the blend of theirs.
/// @return nothing when too few landmarks are given for that
[[nodiscard]] std::optional<Posed> poseByLandmarks(const Mesh& connectivity,
                                                   const std::vector<Eigen::Vector3d>& positions,
                                                   const Places& own, const Places& wanted);

/// The same with each segment's motion given, in the order of bodySegments().
[[nodiscard]] Posed poseBySegments(const Mesh& connectivity,
                                   const std::vector<Eigen::Vector3d>& positions,
                                   const std::vector<std::uint32_t>& segmentOf,
                                   const std::vector<Similarity>& motions);

}  // namespace toile::fitting
