// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "edit/sketch.h"

namespace toile::detail {

/// All curves of a design on the surface, live mirror images too, with every meeting a data point
/// of all the curves that meet there, bit for bit the same.
struct CurveNetwork {
  std::vector<WorkCurve> curves;                       ///< parallel to Design::curves
  std::vector<std::optional<std::size_t>> originalOf;  ///< of a live mirror image
};

/// Puts every curve on the model and shares the meetings, also of images: what becomes a data point
/// of an image becomes, mirrored, one of its original where vertices are paired.
Result<CurveNetwork> makeNetwork(Sketch& sketch);

/// An end that lies this close beside another curve ends on it, mm: what cutting merges.
inline constexpr double kEndsOn = 0.01;

}  // namespace toile::detail
