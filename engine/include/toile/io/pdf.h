// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "toile/io/sheet_drawing.h"

namespace toile {

/// What it is printed on.
enum class PdfPaper {
  A4OrLetter,  ///< A4 pages whose tiles print on Letter too
  A4,
  Letter,
  A3,
  A0,
  OneSheet  ///< one page as large as the sheet, for plotters and projectors
};
/// "a4-letter", "a4", "letter", "a3", "a0", "one". @return InvalidArgument with the list of these
Result<PdfPaper> parsePdfPaper(std::string_view text);

/// The greatest side of a sheet that one page holds with what stands beside it.
inline constexpr double kMostPdfSheetMm = 4900;

struct PdfOptions {
  PdfPaper paper = PdfPaper::A4OrLetter;
  /// mm that neighbouring tiles share, to glue one on the other; 0 = cut and butted. At most 30.
  double overlap = 0;
};

/// The sheet 1:1 as vector PDF without creation time (SOURCE_DATE_EPOCH or none), text searchable,
/// /PrintScaling /None, a 100 mm test square.
/// Of tiles only those that hold something are printed; the first page is their map, with squares
/// of 100 mm and 4 inches to measure.
/// @return the bytes; Unsupported when the sheet exceeds what one PDF page can hold;
///   InvalidArgument for an overlap out of range.
Result<std::string> writePdf(const SheetDrawing& sheet, const PdfOptions& options = {});

}  // namespace toile
