// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/layout/pattern.h"

namespace toile {

struct PdfOptions {
  /// Tiles that print on A4 and on Letter alike, first page a map with the 100 mm test square;
  /// otherwise one large page per sheet.
  bool tiled = true;
};

/// The layout 1:1 as vector PDF without creation time (SOURCE_DATE_EPOCH or none), text searchable,
/// /PrintScaling /None, a 100 mm test square.
/// @return the bytes; Unsupported when the sheet exceeds what a PDF page can hold and tiling is
/// off.
Result<std::string> writePdf(const Pattern& pattern, const PdfOptions& options = {});

}  // namespace toile
