// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "render/ray_scene.h"
#include "render/studio_light.h"

namespace toile {

/// The soft shadow of a model on the ground below it.
class GroundShadow {
 public:
  /// @param low, high box of what stands there, mm
  GroundShadow(const RayScene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high);

  /// Per point of the grid 0 (lit) .. 1 (dark), fading to 0 at its rim.
  [[nodiscard]] std::vector<float> darkness(std::span<const Eigen::Vector3f> light) const;
  /// Where a ray meets the ground; 0 beside the grid and where it does not.
  [[nodiscard]] float at(const std::vector<float>& darkness, const Eigen::Vector3f& origin,
                         const Eigen::Vector3f& direction) const;
  /// Beyond these there is none.
  [[nodiscard]] std::array<Eigen::Vector3f, 4> corners() const;
  [[nodiscard]] const SkyView& sky() const { return sky_; }

 private:
  Eigen::Vector3f corner_;  ///< of the grid, on the ground
  float step_ = 1;          ///< mm between points
  int columns_ = 2, rows_ = 2;
  SkyView sky_;
};

}  // namespace toile
