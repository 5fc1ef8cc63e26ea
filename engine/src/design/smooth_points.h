// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "curve/local_closest.h"
#include "toile/curve/geodesic.h"
#include "toile/curve/subdivision.h"
#include "toile/mesh/surface_index.h"

namespace toile::detail {

/// Data points of a smooth curve through surface points: subdivided in space, put on the surface by
/// closest point. The control points themselves are among them, unchanged.
///
/// Where the closest point would lie on another limb (its way over the surface is much longer than
/// the step), the closest point is taken among the surface that hangs together around the geodesic
/// between the two control points.
Result<std::vector<SurfacePoint>> smoothPoints(const SurfaceIndex& index, GeodesicLinker& linker,
                                               const std::vector<SurfacePoint>& controls,
                                               bool closed, SubdivisionRule rule,
                                               std::span<const std::size_t> corners = {});

}  // namespace toile::detail
