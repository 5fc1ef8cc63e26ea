// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scan/oriented_points.h"
#include "toile/core/progress.h"
#include "toile/mesh/mesh.h"

namespace toile::scanning {

/// The closed surface through oriented points; what they leave open is closed smoothly. A regular
/// grid of cubes of side `cell` is cut where the indicator function changes its sign.
///
/// @return a closed mesh, of one part or several, or an Error:
///   NotConverged  the points have no inside and outside, or the surface does not end
///   Cancelled
/// @par Cost  about 5 s for 80k points
/// @see Kazhdan, Bolitho and Hoppe, "Poisson Surface Reconstruction", SGP 2006; Bloomenthal,
///   "Polygonization of Implicit Surfaces", CAGD 5(4), 1988.
[[nodiscard]] Result<Mesh> reconstruct(const OrientedPoints& cloud, double cell,
                                       const Progress* progress);

}  // namespace toile::scanning
