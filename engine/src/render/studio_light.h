// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/ray_scene.h"

namespace toile {

/// Which of some directions are free at each point: traced once, then any light from any side is a
/// sum over them. That gives soft shadows in every view for one lot of rays. Points take turns with
/// several sets of directions, so that neighbours together see many more.
struct SkyView {
  static constexpr std::size_t kSets = 5;
  static constexpr std::size_t kMostDirections = 128;
  using Mask = std::array<std::uint64_t, kMostDirections / 64>;
  static constexpr Mask kAllOpen = {~std::uint64_t{0}, ~std::uint64_t{0}};

  std::vector<Eigen::Vector3f> directions;  ///< set after set, each evenly over the sphere
  std::vector<Mask> open;                   ///< per point, of its set
  [[nodiscard]] std::size_t perSet() const { return directions.size() / kSets; }
};

/// @param lift mm off the surface where rays start
/// @param reach mm: surface beyond does not shade
SkyView computeSkyView(const RayScene& scene, std::span<const Eigen::Vector3f> points,
                       std::span<const Eigen::Vector3f> normals, float lift, float reach);

/// The studio as the camera sees it: a large lamp high on the left, a pale one behind on the right
/// that draws the edge, bright walls, a darker floor.
/// @return light per direction, so that an open surface facing the lamp and the eye has about 1
std::vector<Eigen::Vector3f> studioLight(std::span<const Eigen::Vector3f> directions,
                                         const Eigen::Vector3f& right, const Eigen::Vector3f& up,
                                         const Eigen::Vector3f& towardsEye);

/// What falls on a surface of that normal at a point of the view.
Eigen::Vector3f irradiance(const SkyView& sky, std::size_t point,
                           std::span<const Eigen::Vector3f> light, const Eigen::Vector3f& normal);
/// The same where nothing is in the way.
Eigen::Vector3f openIrradiance(const SkyView& sky, std::span<const Eigen::Vector3f> light,
                               const Eigen::Vector3f& normal);

}  // namespace toile
