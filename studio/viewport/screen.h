// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "toile/curve/view.h"

namespace toile::studio {

/// A view as it is shown in a window: between pixels, the plane of the view and space.
///
/// Pixels count from the top left corner, y down; the plane is that of toile::View (mm, y up).
struct Screen {
  View view;
  double width = 800;   ///< px
  double height = 600;  ///< px

  [[nodiscard]] double pixelsPerMm() const { return height / view.height; }
  [[nodiscard]] Eigen::Vector2d toPlane(const Eigen::Vector2d& pixel) const;
  [[nodiscard]] Ray rayAt(const Eigen::Vector2d& pixel) const;
  /// Nothing for a place behind the eye.
  [[nodiscard]] std::optional<Eigen::Vector2d> toPixel(const Eigen::Vector3d& place) const;
  /// mm that a pixel covers at the depth of a place.
  [[nodiscard]] double mmPerPixelAt(const Eigen::Vector3d& place) const;
  /// Towards the eye.
  [[nodiscard]] Eigen::Vector3d towardsEye(const Eigen::Vector3d& place) const;
  /// Clip coordinates of OpenGL; depth covers what lies within `radius` mm of `centre`.
  [[nodiscard]] Eigen::Matrix4d clipFromWorld(const Eigen::Vector3d& centre, double radius) const;
};

}  // namespace toile::studio
