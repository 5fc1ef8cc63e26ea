// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/mesh/surface_point.h"

namespace toile {

/// Where two paths meet: they cross, touch, or one ends on the other.
struct PathMeeting {
  double a = 0;        ///< mm along the first path
  double b = 0;        ///< mm along the second
  SurfacePoint point;  ///< on both; a point of a path where one is nearer than kSameMeeting
};

/// Meetings nearer to each other than this, along both paths, are one. In mm.
inline constexpr double kSameMeeting = 1e-6;

/// All meetings of two paths, in order along the first. Of a stretch that both share, its ends.
/// Worked out face by face in barycentric weights; a meeting on a common point of both is exact.
/// @par Cost  linear in the segments, and quadratic per face
std::vector<PathMeeting> findMeetings(const Mesh& mesh, const SurfacePath& first,
                                      const SurfacePath& second);
/// Where a path crosses itself: a < b. Neighbouring segments do not count.
std::vector<PathMeeting> findSelfMeetings(const Mesh& mesh, const SurfacePath& path);

/// The place of a path nearest to a place in space.
struct PathFoot {
  double arc = 0;       ///< mm along the path
  double distance = 0;  ///< mm, straight
};
[[nodiscard]] PathFoot nearestOnPath(const Mesh& mesh, const SurfacePath& path,
                                     const Eigen::Vector3d& place);

}  // namespace toile
