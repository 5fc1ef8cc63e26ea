// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/tool.h"

namespace toile::studio {

/// The body below the pointer.
[[nodiscard]] std::optional<RayHit> hitBody(const ToolHost& host, const Eigen::Vector2d& pixel);
/// Whether nothing of the body stands between the eye and a place on its surface.
[[nodiscard]] bool isVisible(const ToolHost& host, const Eigen::Vector3d& place,
                             const Eigen::Vector3d& normal);

/// A line below the pointer.
struct LinePick {
  std::string curve;
  std::size_t segment = 0;  ///< of its path
  double t = 0;             ///< along the segment
  SurfacePoint point;
  Eigen::Vector3d place;
  double fraction = 0;  ///< of its length
  double pixels = 0;    ///< from the pointer
};
/// The nearest visible line within so many pixels, leaving out some.
[[nodiscard]] std::optional<LinePick> pickLine(const ToolHost& host, const Eigen::Vector2d& pixel,
                                               double within,
                                               const std::vector<std::string>& except = {});
/// The place of one line nearest to a place in space. Precondition: the line has points.
[[nodiscard]] LinePick nearestOnLine(const ToolHost& host, const PlacedLine& line,
                                     const Eigen::Vector3d& place);

/// The line in the middle of a symmetric body.
[[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> middleLines(const ReferenceModel& model);

/// Where a new point goes: caught by something near, or just on the body.
struct Snapped {
  SurfacePoint point;
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  std::optional<SnapMark> mark;
  std::string curve;  ///< that it lies on
};
/// Ends and crossings first, then control points, the mid-plane, lines, curves of the model. What
/// is caught is near the body below the pointer, so that nothing behind it catches.
/// @return nothing where the pointer is beside the body.
[[nodiscard]] std::optional<Snapped> snap(const ToolHost& host, const PointerEvent& event,
                                          const std::vector<std::string>& except = {});

}  // namespace toile::studio
