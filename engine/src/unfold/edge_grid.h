// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "unfold/problem.h"

namespace toile::unfolding {

/// Pairs i < j of segments, ascending, whose boxes, made wider by the margin, share a cell of a
/// grid: all that come nearer to each other than twice the margin, and some more.
/// @par Cost  about linear
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> nearSegments(
    const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& segments, double margin);

}  // namespace toile::unfolding
