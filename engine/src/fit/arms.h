// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/placement.h"
#include "fit/segments.h"

namespace toile::fitting {

struct Arms {
  std::vector<Similarity> motions;  ///< per segment of bodySegments()
  /// A landmark that those motions bring to its level along its limb, and the limb's direction.
  struct Level {
    std::string landmark;
    Eigen::Vector3d along;
  };
  std::vector<Level> levels;
};

/// Looks for the arms of a scan that hang otherwise than the placed body's, or are longer or
/// shorter: each arm is turned about its shoulder, then the forearm about the elbow, on a grid of
/// angles and by nearest points; then it is stretched so that its wrist lies where the scan's is,
/// and the hand is turned and stretched to reach as far as the scan's.
///
/// @param body      the template where it was placed
/// @param segmentOf per vertex its place in bodySegments()
/// @param own       the body's landmarks where it was placed
/// @param upright   columns: the placed body's left, back and up
/// @return nothing where the arms lie well as they are and no wrist was found
[[nodiscard]] std::optional<Arms> findArms(const Shape& body,
                                           const std::vector<std::uint32_t>& segmentOf,
                                           const Places& own, const Eigen::Matrix3d& upright,
                                           const Target& target);

}  // namespace toile::fitting
