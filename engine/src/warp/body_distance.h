// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/mesh/surface_index.h"

namespace toile::detail {

/// How far a point is from a body: outside positive.
struct BodyDistance {
  double value = 0;                                   ///< mm
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  ///< unit; the way on which it grows
};

/// Exact where the surface is closed: the nearest face, or the sum of the normals of those that
/// meet there, weighted by angle.
/// @see Baerentzen and Aanaes, "Signed Distance Computation Using the Angle Weighted Pseudonormal",
///   IEEE TVCG 11(3), 2005.
[[nodiscard]] BodyDistance distanceTo(const SurfaceIndex& body, const Eigen::Vector3d& p);
[[nodiscard]] std::vector<BodyDistance> distancesTo(const SurfaceIndex& body,
                                                    const std::vector<Eigen::Vector3d>& points);

}  // namespace toile::detail
