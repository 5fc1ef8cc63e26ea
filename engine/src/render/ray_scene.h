// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace toile {

struct FirstHit {
  std::uint32_t primitive = RTC_INVALID_GEOMETRY_ID;
  float t = std::numeric_limits<float>::infinity();
  float u = 0, v = 0;
  [[nodiscard]] bool exists() const { return primitive != RTC_INVALID_GEOMETRY_ID; }
};

/// An Embree scene of triangles. Thin: owns, asks, forgets. Embree works in float; pictures need
/// no more.
class RayScene {
 public:
  RayScene() = default;
  static RayScene ofTriangles(std::span<const Eigen::Vector3f> positions,
                              std::span<const std::uint32_t> corners);
  ~RayScene();
  RayScene(RayScene&& other) noexcept;
  RayScene& operator=(RayScene&& other) noexcept;

  [[nodiscard]] FirstHit firstHit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                  float near, float far) const;
  [[nodiscard]] bool isBlocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                               float near, float far) const;

 private:
  RayScene(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> corners);
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace toile
