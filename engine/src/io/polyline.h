// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "finish/polygon.h"

namespace toile {

[[nodiscard]] double lengthOf(const Points2& polyline);
/// The point so far along a polyline; its end beyond that. Precondition: it has a point.
[[nodiscard]] Eigen::Vector2d pointAt(const Points2& polyline, double along);

}  // namespace toile
