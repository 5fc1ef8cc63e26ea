// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "toile/cut/cut.h"

namespace toile {

/// How pictures and reports look; one place, so that a line is the same colour everywhere.

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
};
constexpr Colour colourOf(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
          static_cast<std::uint8_t>(rgb)};
}

inline constexpr Colour kClay = colourOf(0xCCC6BE);
inline constexpr Colour kGroundCentre = colourOf(0xECEAE6);  ///< behind the model
inline constexpr Colour kGroundEdge = colourOf(0xD3CFC8);
inline constexpr Colour kSheet = colourOf(0xEFEDE9);  ///< behind the flat pieces
inline constexpr Colour kText = colourOf(0x1F2124);
inline constexpr Colour kSecondText = colourOf(0x55585E);
inline constexpr Colour kCutLine = colourOf(0x6B7078);

/// Light enough that every kind of line reads on them.
inline constexpr std::array<Colour, 6> kFabricTints = {colourOf(0xBCC6CC), colourOf(0xD8C8B0),
                                                       colourOf(0xC6D2BE), colourOf(0xD9C3C9),
                                                       colourOf(0xC9C4DC), colourOf(0xD3D0C8)};

enum class Dash { Solid, Dashes, Dots, LongShort };

struct LineStyle {
  Colour colour;
  Dash dash = Dash::Solid;
  double width = 2;  ///< px
};

inline constexpr double kDashOn = 10, kDashOff = 4;  ///< px, along the line
inline constexpr double kDotSpacing = 5.5;           ///< px
inline constexpr double kLongOn = 12,
                        kLongOff = 3;  ///< px, then a short one of kLongOff, again off

[[nodiscard]] constexpr LineStyle lineStyle(WireKind kind) {
  switch (kind) {
    case WireKind::Seam:
      return {colourOf(0x16202E), Dash::Solid, 2.4};
    case WireKind::Opening:
      return {colourOf(0x16202E), Dash::LongShort, 2.4};
    case WireKind::Dart:
      return {colourOf(0xA34700), Dash::Solid, 2.0};
    case WireKind::Feature:
      return {colourOf(0x0A6650), Dash::Dashes, 2.2};
    case WireKind::Elastic:
      return {colourOf(0xB01C80), Dash::Dots, 3.0};
    case WireKind::Border:
      return {colourOf(0x16202E), Dash::Solid, 1.8};
  }
  return {};
}
[[nodiscard]] constexpr LineStyle lineStyle(CurveKind kind) {
  switch (kind) {
    case CurveKind::Seam:
      return lineStyle(WireKind::Seam);
    case CurveKind::Opening:
      return lineStyle(WireKind::Opening);
    case CurveKind::Dart:
      return lineStyle(WireKind::Dart);
    case CurveKind::Feature:
      return lineStyle(WireKind::Feature);
    case CurveKind::Elastic:
      return lineStyle(WireKind::Elastic);
    case CurveKind::Mark:
    case CurveKind::Guide:
      return {kSecondText, Dash::Dashes, 1.3};
  }
  return {};
}

/// A tint per piece, neighbours across a seam in different ones as far as six go round; clay for
/// pieces that are left out.
[[nodiscard]] std::vector<Colour> pieceColours(const CutResult& cut);

}  // namespace toile
