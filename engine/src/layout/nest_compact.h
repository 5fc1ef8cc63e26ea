// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "finish/polygon.h"

namespace toile::nesting {

/// An outline, grown by half the gap, in its place on a sheet.
struct Lying {
  Points2 outline;
  bool onFold = false;  ///< keeps its height
};

/// Pushes outlines left and down, each until it touches another, a fault or the edges x = 0 and
/// y = 0, again and again while that helps. Exact up to rounding; nothing jumps over anything.
/// @return by how much each was moved
[[nodiscard]] std::vector<Eigen::Vector2d> compact(std::vector<Lying> lying,
                                                   const std::vector<Points2>& faults);

}  // namespace toile::nesting
