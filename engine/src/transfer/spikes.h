// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "edit/sketch.h"

namespace toile::detail {

/// Takes data points out at which a smooth curve turns back on itself: in a sharp fold of the
/// surface a point may come to lie beyond the fold, and the link to it and from it is one way.
/// Points that other curves share stay; their neighbours go instead.
Result<void> removeSpikes(Sketch& sketch, std::span<const std::string> ids);

}  // namespace toile::detail
