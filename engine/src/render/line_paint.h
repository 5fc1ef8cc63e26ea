// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "render/surface_lines.h"

namespace toile {

/// Colours of a part of the surface, linear.
struct ClothPaint {
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();
  Eigen::Vector3f thread = Eigen::Vector3f::Zero();  ///< of stitches and subtle lines on it
};
[[nodiscard]] ClothPaint makeCloth(Colour colour);

/// The surface at a point after its lines are painted: a colour that the light falls on, how far
/// the light gets there, and paint that shines by itself.
struct Painted {
  Eigen::Vector3f colour;
  float shade = 1;
  Eigen::Vector3f ink = Eigen::Vector3f::Zero();
  float inked = 0;    ///< 0..1, share of the ink
  bool fine = false;  ///< varies from pixel to pixel
};

/// Beyond that many px of the line styles no line is painted.
inline constexpr float kPaintReach = 8;

/// Seams flatlocked with a row of stitches on either side, hems with one, zips with teeth, tapes
/// and slider, darts closed; inner lines hardly seen. @param unit mm per px of the line styles
[[nodiscard]] Painted paintProduct(const SurfaceLines::Near& near, const ClothPaint& cloth,
                                   float unit);

/// The lines in the colours and dashes of their kinds.
[[nodiscard]] Painted paintPlain(const SurfaceLines::Near& near, const ClothPaint& cloth,
                                 float unit);

}  // namespace toile
