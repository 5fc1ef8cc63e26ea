// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace toile::fitting {

using Places = std::map<std::string, Eigen::Vector3d>;

/// A stiff part of a body, by landmarks: those around its two ends, and others that lie on it.
struct Segment {
  std::string name;  ///< "left shank"
  std::vector<std::string> from, to, on;
  [[nodiscard]] std::vector<std::string> all() const;
};

/// Head, two parts of the trunk, three of each limb.
[[nodiscard]] const std::vector<Segment>& bodySegments();

/// For every point the segment it belongs to: the one whose axis is nearest, measured in the
/// segment's thickness. Empty where landmarks are missing for an axis.
[[nodiscard]] std::vector<std::uint32_t> segmentOfPoints(const std::vector<Eigen::Vector3d>& points,
                                                         const Places& landmarks);

/// The same for reports, where a hand begins at the level of the wrist's landmarks.
[[nodiscard]] std::vector<std::uint32_t> regionOfPoints(const std::vector<Eigen::Vector3d>& points,
                                                        const Places& landmarks);

}  // namespace toile::fitting
