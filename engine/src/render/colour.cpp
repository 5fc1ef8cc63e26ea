// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace toile {

std::optional<Colour> parseColour(std::string_view text) {
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data() + 1, end, rgb, 16);
  if (code != std::errc() || stop != end) return std::nullopt;
  return colourOf(rgb);
}

std::string toHex(Colour c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

Colour mix(Colour a, Colour b, double t) {
  const auto channel = [t](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1 - t) * from + t * to));
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

double lightness(Colour c) {
  return (0.299 * c.r + 0.587 * c.g + 0.114 * c.b) / 255;
}

Eigen::Vector3f displayOf(Colour c) {
  return Eigen::Vector3f(c.r, c.g, c.b) / 255.0F;
}

Eigen::Vector3f linearOf(Colour c) {
  return displayOf(c).unaryExpr(
      [](float s) { return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F); });
}

Eigen::Vector3f toDisplay(const Eigen::Vector3f& linear) {
  constexpr int kSteps = 4096;
  static const std::vector<float> table = [] {
    std::vector<float> values(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      const double c = std::min(1.0, (i + 0.5) / kSteps);  // the middle of the step
      values[static_cast<std::size_t>(i)] =
          static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
    }
    return values;
  }();
  return linear.unaryExpr(
      [](float x) { return table[static_cast<std::size_t>(std::clamp(x, 0.0F, 1.0F) * kSteps)]; });
}

}  // namespace toile
