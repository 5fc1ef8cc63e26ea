// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/io/sheet_drawing.h"

namespace toile {

struct HpglOptions {
  int drawPen = 1, cutPen = 2, textPen = 3;  ///< 1..8
  bool originInMiddle = false;               ///< some plotters have it there
  bool version2 = true;                      ///< adds PS and PG; HP-GL/1 holds 819 mm
  double overcut = 0;                        ///< mm that a knife goes beyond the end of an outline
};

/// The sheet for a plotter or knife: 40 units a millimetre, each position rounded by itself;
/// IN SP PU PD only, texts as strokes, lines of at most 200 characters. X is the feed of the
/// material: the longer side of the sheet, or the roll of a marker, runs along it.
/// @return Unsupported for HP-GL/1 when the sheet is longer or wider than its 819 mm, or for what
///   no plotter holds (50 m); InvalidArgument for pens and overcuts out of range.
Result<std::string> writeHpgl(const SheetDrawing& sheet, const HpglOptions& options = {});

}  // namespace toile
