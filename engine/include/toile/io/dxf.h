// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile {

struct DxfFile {
  std::string text;               ///< 7-bit ASCII, CRLF
  std::vector<Finding> findings;  ///< names that had to be transliterated or shortened
};

/// Pattern pieces by the layer convention of ASTM D6673-10 (withdrawn): R12 entities, no handles,
/// no tables, one BLOCK per piece with coordinates already in place on the sheet, one INSERT each
/// at 0,0; millimetres, y up, right side of the cloth up, outlines clockwise.
DxfFile writeDxf(const Pattern& pattern);

}  // namespace toile
