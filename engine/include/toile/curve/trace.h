// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "toile/mesh/surface_point.h"

namespace toile {

/// Walks straight over the surface: across an edge as if its two faces lay flat, through a vertex
/// with equal angles on both sides.
///
/// @param direction is put into the tangent plane of the face that it leads into.
/// @param length mm
/// @return an open path, as long as `length` unless the border of the model ends it; nullopt when
///   no step is possible (the direction stands on the surface, or leads over the border at once).
/// @see Polthier, Schmies, "Straightest geodesics on polyhedral surfaces", 1998.
std::optional<SurfacePath> traceStraight(const Mesh& mesh, const SurfacePoint& from,
                                         const Eigen::Vector3d& direction, double length);

}  // namespace toile
