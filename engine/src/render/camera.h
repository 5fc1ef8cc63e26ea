// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "toile/render/render.h"

namespace toile {

/// Looks at a middle, that of the model or of a close-up, the vertical upright in the picture.
struct Camera {
  Eigen::Vector3d eye, right, up, forward;
  double distance = 1;  ///< of the eye from the middle
};

[[nodiscard]] Camera makeCamera(const Eigen::Vector3d& middle, double diagonal,
                                const RenderView& view);

/// Where a point appears in the plane through the middle, mm.
[[nodiscard]] Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point);

}  // namespace toile
