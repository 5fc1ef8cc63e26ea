// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit/sketch.h"

namespace toile::detail {

/// Whether the first link of an open curve begins on the middle line and leaves it square, so that
/// it and its mirror image go straight into each other.
[[nodiscard]] bool beginsSquare(const Sketch& sketch, const WorkCurve& curve);

/// Makes the first link of an open curve that begins on the middle line leave it square: by its
/// first data point, or by a new one where that is a control point, another line's, or far away.
void beginSquare(Sketch& sketch, const std::string& id, WorkCurve& curve);

}  // namespace toile::detail
