// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toile/io/sheet_drawing.h"
#include "toile/layout/pattern.h"

namespace toile {

struct DxfFile {
  std::string text;               ///< 7-bit ASCII, CRLF
  std::vector<Finding> findings;  ///< names that had to be transliterated or shortened
};

enum class DxfDialect {
  Strict,  ///< ASTM texts, nothing in the file but pieces: what AccuMark reads
  Rich,    ///< the same with header and layer tables, for drawing programs
  Aama     ///< texts of AAMA-292, without layers 15 and 84 to 87, nothing but pieces
};

struct DxfOptions {
  DxfDialect dialect = DxfDialect::Strict;
  bool inches = false;  ///< Units:ENGLISH
};

/// Pattern pieces by the layer convention of ASTM D6673-10 (withdrawn): R12 entities, no handles,
/// one BLOCK per piece with coordinates already in place on the sheet, one INSERT each at 0,0;
/// y up, right side of the cloth up, outlines clockwise.
DxfFile writeDxf(const Pattern& pattern, const DxfOptions& options = {});

/// The pieces of a sheet for a laser or knife: plain polylines without blocks, millimetres, on
/// three layers in the order in which they are worked: ENGRAVE (green: labels as strokes), MARK
/// (blue: sew lines, inner lines, notches, drill holes, grain), CUT (red: holes, then outlines).
std::string writeLaserDxf(const SheetDrawing& sheet);

/// Names of the blocks that writeDxf() gives to the pieces, in their order.
std::vector<std::string> dxfBlockNames(const Pattern& pattern);

}  // namespace toile
