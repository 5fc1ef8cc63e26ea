// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <numbers>
#include <vector>

namespace toile::body {

/// Parameters from 0 to 2 pi at which `count` points divide a closed curve into equal lengths,
/// the first at 0.
template <typename Curve>
std::vector<double> evenParameters(const Curve& curve, std::size_t count) {
  constexpr std::size_t kSamples = 120;
  std::array<double, kSamples + 1> length{};
  Eigen::Vector2d before = curve(0);
  for (std::size_t i = 1; i <= kSamples; ++i) {
    const Eigen::Vector2d here = curve(2 * std::numbers::pi * static_cast<double>(i) / kSamples);
    length[i] = length[i - 1] + (here - before).norm();
    before = here;
  }
  std::vector<double> out{0};
  std::size_t i = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const double wanted = length[kSamples] * static_cast<double>(k) / static_cast<double>(count);
    while (length[i + 1] < wanted) ++i;
    const double part = (wanted - length[i]) / (length[i + 1] - length[i]);
    out.push_back(2 * std::numbers::pi * (static_cast<double>(i) + part) / kSamples);
  }
  return out;
}

}  // namespace toile::body
