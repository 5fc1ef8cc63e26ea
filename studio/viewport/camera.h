// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "viewport/screen.h"

namespace toile::studio {

enum class StandardView { Front, Back, Left, Right, Top, Bottom };

/// Where the body is looked at from: a turntable, so that the vertical stays vertical.
struct Camera {
  Eigen::Vector3d target{0, 0, 900};  ///< mm
  double azimuth = 0;                 ///< radians: 0 sees the front, pi/2 the body's left side
  double elevation = 0;               ///< radians, -pi/2..pi/2
  double height = 2000;               ///< mm seen from bottom to top, at the target

  [[nodiscard]] View view() const;
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Turned by a drag of so many pixels; the width of the window is half a turn.
[[nodiscard]] Camera turned(Camera camera, const Eigen::Vector2d& drag, const Screen& screen);
/// What is below the cursor stays below it.
[[nodiscard]] Camera panned(Camera camera, const Eigen::Vector2d& drag, const Screen& screen);
/// factor > 1 comes nearer; what lies below `pixel` at the target's depth stays there.
[[nodiscard]] Camera zoomed(Camera camera, double factor, const Eigen::Vector2d& pixel,
                            const Screen& screen);
/// The whole box is seen, from the same side.
[[nodiscard]] Camera fitted(Camera camera, const Eigen::Vector3d& boxMin,
                            const Eigen::Vector3d& boxMax, double aspect);
[[nodiscard]] Camera seenFrom(Camera camera, StandardView side);
/// Looks against a direction: straight at a surface with that normal.
[[nodiscard]] Camera lookingAlong(Camera camera, const Eigen::Vector3d& normal);
/// Between two cameras, t = 0..1, the shorter way round.
[[nodiscard]] Camera between(const Camera& from, const Camera& to, double t);

}  // namespace toile::studio
