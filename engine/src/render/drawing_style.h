// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "render/colour.h"
#include "toile/cut/cut.h"

namespace toile {

/// How pictures and reports look; one place, so that a line is the same colour everywhere.

inline constexpr Colour kGroundCentre = colourOf(0xF2F0ED);  ///< behind the model
inline constexpr Colour kGroundEdge = colourOf(0xD6D3CD);
inline constexpr Colour kSheet = colourOf(0xF6F5F2);  ///< behind the flat pieces
inline constexpr Colour kText = colourOf(0x1F2124);
inline constexpr Colour kSecondText = colourOf(0x55585E);
inline constexpr Colour kCutLine = colourOf(0x6B7078);

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

}  // namespace toile
