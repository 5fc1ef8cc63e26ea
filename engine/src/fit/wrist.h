// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace toile::fitting {

/// A forearm on its way to the hand.
struct Forearm {
  Eigen::Vector3d elbow, wrist;  ///< mm, middles; the wrist about where it should be
  [[nodiscard]] double length() const { return (wrist - elbow).norm(); }
  [[nodiscard]] Eigen::Vector3d axis() const { return (wrist - elbow).normalized(); }
};

/// Where an arm is thinnest before the hand, mm along the axis from the elbow: girths of thin
/// slices (of their convex hulls) from the middle of the forearm on, until they have grown by a
/// fifth.
/// @param points of the arm and the hand; what lies far from the axis is left out
/// @return nothing where the girth never grows like that: no hand, or a sleeve
[[nodiscard]] std::optional<double> wristAlong(const Forearm& forearm,
                                               const std::vector<Eigen::Vector3d>& points);

}  // namespace toile::fitting
