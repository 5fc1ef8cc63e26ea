// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/studio_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t kRays = 500'000;  // for all points together
constexpr std::size_t kLeastDirections = 24;
// Grazing rays meet the facets of the surface itself.
constexpr float kGrazing = 0.05F;

/// Golden spirals, each shifted and turned against the others.
std::vector<Vector3f> sphereDirections(std::size_t perSet) {
  std::vector<Vector3f> directions;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t set = 0; set < SkyView::kSets; ++set) {
    const double share = (static_cast<double>(set) + 0.5) / SkyView::kSets;
    for (std::size_t i = 0; i < perSet; ++i) {
      const double at = static_cast<double>(i) + share;
      const double z = 1 - 2 * at / static_cast<double>(perSet);
      const double r = std::sqrt(1 - z * z);
      const double angle = golden * at + 2.4 * static_cast<double>(set);
      directions.push_back(Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>());
    }
  }
  return directions;
}

/// Scattered, so that it does not follow the order in which a mesh numbers its rows of vertices.
std::size_t setOf(std::size_t point) {
  const auto mixed = static_cast<std::uint32_t>(point) * 2654435761U;
  return (mixed >> 16U) % SkyView::kSets;
}

}  // namespace

SkyView computeSkyView(const RayScene& scene, std::span<const Vector3f> points,
                       std::span<const Vector3f> normals, float lift, float reach) {
  SkyView sky;
  const std::size_t count = points.size();
  sky.directions = sphereDirections(std::clamp(kRays / std::max<std::size_t>(count, 1),
                                               kLeastDirections, SkyView::kMostDirections));
  sky.open.assign(count, SkyView::kAllOpen);
  constexpr std::size_t kBlock = 256;
  parallelFor((count + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      const Vector3f origin = points[i] + lift * normals[i];
      const Vector3f* directions = sky.directions.data() + setOf(i) * sky.perSet();
      for (std::size_t k = 0; k < sky.perSet(); ++k) {
        if (normals[i].dot(directions[k]) <= kGrazing) continue;
        if (scene.isBlocked(origin, directions[k], 0, reach)) {
          sky.open[i][k / 64] &= ~(std::uint64_t{1} << (k % 64));
        }
      }
    }
  });
  return sky;
}

std::vector<Vector3f> studioLight(std::span<const Vector3f> directions, const Vector3f& right,
                                  const Vector3f& up, const Vector3f& towardsEye) {
  const auto from = [&](float x, float y, float z) {
    return Vector3f((x * right + y * up + z * towardsEye).normalized());
  };
  const Vector3f key = from(-0.62F, 0.62F, 0.62F);
  const Vector3f edge = from(0.85F, 0.25F, -0.45F);
  const Vector3f warm(1.0F, 0.975F, 0.94F);
  const Vector3f cool(0.955F, 0.98F, 1.0F);
  std::vector<Vector3f> light(directions.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Vector3f& d = directions[k];
    const float lamp = std::pow(std::max(0.0F, d.dot(key)), 7.0F);
    const float behind = std::pow(std::max(0.0F, d.dot(edge)), 5.0F);
    const float walls = 0.62F + 0.38F * d.z();
    light[k] = 3.3F * lamp * warm + 0.9F * behind * cool + 0.52F * walls * cool;
  }
  SkyView all;
  all.directions.assign(directions.begin(), directions.end());
  const float full = openIrradiance(all, light, from(-0.3F, 0.3F, 0.9F)).mean();
  for (Vector3f& each : light) each *= 1.04F / full;
  return light;
}

Vector3f irradiance(const SkyView& sky, std::size_t point, std::span<const Vector3f> light,
                    const Vector3f& normal) {
  const SkyView::Mask& open = sky.open[point];
  const std::size_t first = setOf(point) * sky.perSet();
  Vector3f sum = Vector3f::Zero();
  for (std::size_t k = 0; k < sky.perSet(); ++k) {
    const float cosine = normal.dot(sky.directions[first + k]);
    if (cosine <= kGrazing || (open[k / 64] >> (k % 64) & 1U) == 0) continue;
    sum += cosine * light[first + k];
  }
  return sum * (4.0F / static_cast<float>(sky.perSet()));
}

Vector3f openIrradiance(const SkyView& sky, std::span<const Vector3f> light,
                        const Vector3f& normal) {
  Vector3f sum = Vector3f::Zero();
  for (std::size_t k = 0; k < light.size(); ++k) {
    sum += std::max(0.0F, normal.dot(sky.directions[k])) * light[k];
  }
  return sum * (4.0F / static_cast<float>(light.size()));
}

}  // namespace toile
