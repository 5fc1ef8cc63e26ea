// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "finish/polygon.h"

namespace toile {

/// A range of shifts, in mm.
struct ShiftRange {
  double from = 0;
  double to = 0;
};

/// The outline of a polygon grown by `distance` all round, with few vertices: it holds every point
/// within `distance` of the polygon and none farther than `distance` + 2.5 `tolerance`. Holes are
/// filled.
[[nodiscard]] Points2 grown(const Points2& polygon, double distance, double tolerance = 0.4);

/// Adds the shifts t for which `moving`, shifted by t along the axis (0 = x, 1 = y), shares inner
/// points with `fixed`. Exact up to rounding: both are split into trapezoids over common slabs.
/// @par Cost  quadratic in the number of vertices
void addBlockedShifts(const Points2& moving, const Points2& fixed, int axis,
                      std::vector<ShiftRange>& blocked);

/// The least t >= 0 outside of all ranges (of their inner points).
[[nodiscard]] double leastFreeShift(std::vector<ShiftRange> blocked);

/// Least distance between the lines of two polygons; 0 where they cross or one holds the other.
[[nodiscard]] double distanceBetween(const Points2& a, const Points2& b);

/// Where two edges of a polygon cross, other than in a common end; nothing in a simple polygon.
/// Edges that only touch do not cross.
[[nodiscard]] std::optional<Eigen::Vector2d> findSelfCrossing(const Points2& polygon);

}  // namespace toile
