// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "toile/core/result.h"
#include "toile/core/units.h"

namespace toile {

/// What a pen or mouse reports.
struct StrokeSample {
  Eigen::Vector2d place;  ///< mm in the plane of the view
  double time = 0;        ///< seconds; all equal = not known
  double pressure = 1;    ///< 0..1; all equal = not known
};

struct StrokeOptions {
  double tolerance = 5;  ///< mm that the curve may lie beside the stroke: more than the trembling
  std::optional<bool> closed;  ///< absent: closed when the stroke comes back to its start
};

/// A stroke as a curve of few control points.
struct FittedStroke {
  std::vector<Eigen::Vector2d> controls;
  std::vector<std::size_t> corners;  ///< indices of sharp controls, ascending
  bool closed = false;
  double deviation = 0;  ///< mm, greatest distance of a sample from the curve
};

inline constexpr std::size_t kMaxStrokeSamples = 200000;

/// Fits a freehand stroke.
///
/// A corner is where the direction changes by more than about 50 degrees within a few tolerances
/// and not along an arc; less is enough where the pen was slowed down, more is needed where it was
/// not. Between corners the fewest evenly spaced control points whose 4-point curve, by least
/// squares, stays within the tolerance; then those that can be spared are left out. Hooks at both
/// ends, drawn with less than a tenth of the usual pressure, are cut off.
///
/// @return CurveInvalid for fewer than two places, or a stroke shorter than the tolerance;
///   InvalidArgument for numbers that are not finite, a tolerance <= 0, too many samples.
/// @par Cost  linear in the samples for each number of control points tried
Result<FittedStroke> fitStroke(std::span<const StrokeSample> stroke,
                               const StrokeOptions& options = {});

}  // namespace toile
