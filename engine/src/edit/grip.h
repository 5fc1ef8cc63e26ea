// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit/sketch.h"

namespace toile::detail {

/// A stretch as data points: `turned` is where the closed curve was rotated to.
struct Grip {
  WorkCurve curve;
  std::size_t turned = 0;
  std::vector<std::size_t> handles;  ///< data points, ascending; ends of the stretch are not among
                                     ///< them unless they are ends of the curve
  std::size_t first = 0, last = 0;   ///< data points
};

/// Takes hold of a stretch of a curve of the document, or of the curve that it mirrors.
Result<Grip> gripOf(Sketch& sketch, const Sketch::Target& target, const std::string& curve,
                    const Stretch& stretch);

/// Opens a ring that is held as a whole opposite to the handle that is pulled: the start, doubled,
/// is the first and the last knot of the stretch and stays.
void openRing(Grip& grip, std::size_t& handle);

}  // namespace toile::detail
