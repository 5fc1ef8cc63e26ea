// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace toile {

/// An 8-bit sRGB colour.
struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};
constexpr Colour colourOf(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
          static_cast<std::uint8_t>(rgb)};
}
/// "#rrggbb"; nothing for any other text.
[[nodiscard]] std::optional<Colour> parseColour(std::string_view text);
[[nodiscard]] std::string toHex(Colour colour);

/// t of the way from a to b, by display values.
[[nodiscard]] Colour mix(Colour a, Colour b, double t);
/// 0 black, 1 white, as the eye weighs the channels.
[[nodiscard]] double lightness(Colour colour);

/// Light is added in linear values; display values are where steps look even.
[[nodiscard]] Eigen::Vector3f displayOf(Colour colour);
[[nodiscard]] Eigen::Vector3f linearOf(Colour colour);
/// By table, clamped to 0..1: it is asked for every sample, and pictures have eight bits.
[[nodiscard]] Eigen::Vector3f toDisplay(const Eigen::Vector3f& linear);

}  // namespace toile
