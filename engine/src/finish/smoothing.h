// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "finish/polygon.h"
#include "finish/seam_net.h"

namespace toile {

/// Points may be left out where the line between the others stays this close to them.
inline constexpr double kSmoothingDistanceMm = 0.05;

/// Leaves out points of the sew lines, the same ones on both mates, so that no run gets shorter by
/// more than kSmoothingMm; ends of runs and of inner lines and corners stay. Sets `arcEnds` of the
/// runs. A mirrored piece keeps the mirrored points.
void smoothSewLines(std::vector<PieceInWork>& pieces, const SeamNet& net);

/// A circular arc between two points that is as long as the polyline which it replaces.
struct EqualArc {
  double radius = 0;    ///< mm; 0 = a straight line
  bool toLeft = false;  ///< it bends to the left of the way
};

/// The arc through the first and last point with the length of the polyline, if it passes all its
/// points within kSmoothingDistanceMm and turns by less than half a circle.
[[nodiscard]] std::optional<EqualArc> equalArc(std::span<const Eigen::Vector2d> points);

}  // namespace toile
