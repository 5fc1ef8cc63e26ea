// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "toile/fit/scan.h"

namespace toile::scanning {

/// The diagonal of the box around a scan, without the outermost fiftieth at each end of an axis.
[[nodiscard]] double extentWithoutSpecks(const std::vector<Eigen::Vector3d>& points);

/// Points that hang together, by faces or because they are near.
struct Parts {
  std::vector<std::uint32_t> ofPoint;
  std::vector<std::size_t> size;  ///< in cubes that hold points of it; largest first
};

/// @param link points nearer than this hang together; some up to twice as far
[[nodiscard]] Parts findParts(const Scan& scan, double link);

/// How near the points of a cloud lie to each other.
struct Crowding {
  double reach = 0;           ///< mm that hold eight neighbours, of most points
  std::vector<char> isAlone;  ///< needs several times that
};
[[nodiscard]] Crowding findCrowding(const std::vector<Eigen::Vector3d>& points);

/// The points that are kept, with the faces between them.
[[nodiscard]] Scan keepPoints(const Scan& scan, const std::function<bool(std::size_t)>& isKept);

/// Neighbouring faces run along their edges against each other, but for a few.
[[nodiscard]] bool isConsistentlyOriented(const Scan& scan);

}  // namespace toile::scanning
