// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit/sketch.h"

namespace toile::detail {

/// A part of a curve that is kept, by arc lengths of the old curve.
struct KeptPart {
  double from = 0;
  double to = 0;  ///< beyond the length of a closed curve when it runs over its start
};

/// Puts parts of a curve in its place: the first keeps the id, the others come beside it; its live
/// mirror images get the same parts, and what hangs on it follows.
/// @return the ids of the parts (of the target itself, not of images).
Result<std::vector<std::string>> replaceByParts(Sketch& sketch, const std::string& id,
                                                const WorkCurve& old,
                                                const std::vector<KeptPart>& parts);

/// A closed curve that keeps its shape but not its fractions, a reversed one and so on: stores it
/// and lets hangers follow.
Result<void> storeAndMove(Sketch& sketch, const std::string& id, const WorkCurve& curve,
                          const Sketch::Moving& moving);

/// Ends without control points of a part become ones.
void markEnds(WorkCurve& curve);

}  // namespace toile::detail
