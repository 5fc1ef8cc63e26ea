// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "fit/placement.h"
#include "fit/segments.h"

namespace toile::fitting {

/// Looks for the arms of a scan that hang otherwise than the placed body's: each arm is turned
/// about its shoulder, then the forearm about the elbow, on a grid of angles and by nearest points.
///
/// @param body      the template where it was placed
/// @param segmentOf per vertex its place in bodySegments()
/// @param own       the body's landmarks where it was placed
/// @param upright   columns: the placed body's left, back and up
/// @return per segment of bodySegments() how it moves; nothing where the arms lie well as they are
[[nodiscard]] std::optional<std::vector<Similarity>> findArms(
    const Shape& body, const std::vector<std::uint32_t>& segmentOf, const Places& own,
    const Eigen::Matrix3d& upright, const Target& target);

}  // namespace toile::fitting
