// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "body/subdivision.h"
#include "toile/body/body.h"

namespace toile::body {

/// What kind of body, apart from its measurements.
struct Form {
  double masculine = 0;  ///< 0 female .. 1 male
  double childlike = 0;  ///< 0 adult .. 1 about five years
};

/// How far the left foot points to the left, radians.
inline constexpr double kToesOut = 0.105;

/// One number per measure: about the log of the factor on what the form has by itself.
using Dials = std::array<double, kBodyMeasureCount>;

/// Control points of the body in A-pose, mm; exactly symmetric in x, the floor near z = 0.
/// @param height mm, turned by the dial of the height
Points controlPoints(const Form& form, double height, const Dials& dials);

}  // namespace toile::body
