// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/ground_shadow.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

using Eigen::Vector3f;

constexpr int kPoints = 56;    // along the longer side
constexpr float kRim = 0.22F;  // of the model's diagonal, beyond its box
constexpr int kSmoothing = 4;  // rounds: neighbours share their directions of the sky

}  // namespace

GroundShadow::GroundShadow(const RayScene& scene, const Vector3f& low, const Vector3f& high) {
  const float diagonal = (high - low).norm();
  const Vector3f rim(kRim * diagonal, kRim * diagonal, 0);
  corner_ = low - rim;
  const Vector3f size = high + rim - corner_;
  step_ = std::max(size.x(), size.y()) / (kPoints - 1);
  columns_ = std::max(2, static_cast<int>(std::ceil(size.x() / step_)) + 1);
  rows_ = std::max(2, static_cast<int>(std::ceil(size.y() / step_)) + 1);
  std::vector<Vector3f> points;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      points.emplace_back(corner_ +
                          step_ * Vector3f(static_cast<float>(column), static_cast<float>(row), 0));
    }
  }
  const std::vector<Vector3f> normals(points.size(), Vector3f::UnitZ());
  sky_ = computeSkyView(scene, points, normals, 1e-4F * diagonal, 2 * diagonal);
}

std::vector<float> GroundShadow::darkness(std::span<const Vector3f> light) const {
  const auto index = [this](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  };
  const float full = openIrradiance(sky_, light, Vector3f::UnitZ()).mean();
  std::vector<float> result(sky_.open.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t i = index(column, row);
      const float lit = irradiance(sky_, i, light, Vector3f::UnitZ()).mean() / full;
      const auto toRim =
          static_cast<float>(std::min({column, row, columns_ - 1 - column, rows_ - 1 - row}));
      result[i] =
          std::max(0.0F, 1 - lit) * std::min(1.0F, toRim * step_ / (0.2F * step_ * kPoints));
    }
  }
  for (int round = 0; round < kSmoothing; ++round) {
    std::vector<float> smooth = result;
    for (int row = 1; row + 1 < rows_; ++row) {
      for (int column = 1; column + 1 < columns_; ++column) {
        float sum = 4 * result[index(column, row)];
        for (const int side : {-1, 1}) {
          sum += 2 * (result[index(column + side, row)] + result[index(column, row + side)]);
          sum += result[index(column + side, row - 1)] + result[index(column + side, row + 1)];
        }
        smooth[index(column, row)] = sum / 16;
      }
    }
    result = std::move(smooth);
  }
  return result;
}

std::array<Vector3f, 4> GroundShadow::corners() const {
  const Vector3f x(step_ * static_cast<float>(columns_ - 1), 0, 0);
  const Vector3f y(0, step_ * static_cast<float>(rows_ - 1), 0);
  return {corner_, corner_ + x, corner_ + x + y, corner_ + y};
}

float GroundShadow::at(const std::vector<float>& darkness, const Vector3f& origin,
                       const Vector3f& direction) const {
  if (direction.z() > -1e-3F) return 0;
  const Vector3f hit = origin + (corner_.z() - origin.z()) / direction.z() * direction;
  const float x = (hit.x() - corner_.x()) / step_;
  const float y = (hit.y() - corner_.y()) / step_;
  if (!(x >= 0 && y >= 0) || x >= static_cast<float>(columns_ - 1) ||
      y >= static_cast<float>(rows_ - 1)) {
    return 0;
  }
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  const float s = x - static_cast<float>(column);
  const float t = y - static_cast<float>(row);
  const float* low = darkness.data() + row * static_cast<std::size_t>(columns_) + column;
  const float* high = low + columns_;
  return (1 - t) * ((1 - s) * low[0] + s * low[1]) + t * ((1 - s) * high[0] + s * high[1]);
}

}  // namespace toile
