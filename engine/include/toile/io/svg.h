// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/io/sheet_drawing.h"

namespace toile {

/// The sheet 1:1 in mm (viewBox in mm), a group per piece with a layer per role, data-* attributes
/// with piece, curve and seam ids, no scaling transforms.
std::string writeSvg(const SheetDrawing& sheet);

/// The pattern with a layer per piece beneath its lines that shows how much the area of the cloth
/// must give, and a legend: to look at, not to cut from.
std::string writeStrainSvg(const Pattern& pattern);

}  // namespace toile
