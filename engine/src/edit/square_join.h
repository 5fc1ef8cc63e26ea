// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit/sketch.h"

namespace toile::detail {

/// Whether the first link of an open curve begins on the middle line and leaves it square, so that
/// it and its mirror image go straight into each other.
[[nodiscard]] bool beginsSquare(const Sketch& sketch, const WorkCurve& curve);

/// Makes an open curve that begins on the middle line leave it square, and bend from there into
/// what it was: over its first part, as far as no control point and no other line holds it.
void beginSquare(Sketch& sketch, const std::string& id, WorkCurve& curve);

}  // namespace toile::detail
