// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "finish/polygon.h"
#include "toile/layout/pattern.h"

namespace toile {

/// What a line or text of a pattern piece is; SVG has a layer for each.
enum class SheetRole { Cut, Sew, Internal, Notch, Drill, Grain, Text };
[[nodiscard]] const char* layerName(SheetRole role);

struct LineStyle {
  double width = 0.3;        ///< mm; 0 = there, but not drawn
  std::vector<double> dash;  ///< mm: on, off, ...; empty = solid
};

/// A line on the sheet: mm, y up.
struct SheetLine {
  SheetRole role = SheetRole::Cut;
  Points2 points;
  bool closed = false;
  LineStyle style;
  std::string curve;                   ///< id of the styling curve, if it is one curve's
  std::string kind;                    ///< of the wire or internal line
  int seam = 0;                        ///< number of the seam, 0 = none
  std::string mate;                    ///< id of the piece sewn on
  std::string edge;                    ///< codes of a sewn edge and its mate
  std::vector<std::size_t> arcEnds{};  ///< of a sew line: OutlineRun::arcEnds
};

/// A line of text on the sheet.
struct SheetText {
  SheetRole role = SheetRole::Text;
  Eigen::Vector2d position{0, 0};  ///< middle of the baseline
  double angle = 0;                ///< radians, counter-clockwise
  double size = 4;                 ///< mm, of the em
  bool bold = false;
  std::string text;
};

struct PieceDrawing {
  std::string id, name;
  std::vector<SheetLine> lines;
  std::vector<SheetText> texts;
};

/// All pieces where the layout puts them, as SVG and PDF draw them.
struct SheetDrawing {
  std::vector<PieceDrawing> pieces;
  Box2 box;  ///< of the cut lines
};

/// Cut lines, sew lines by seam, feature lines with names, notches with numbers, the grain line,
/// the label fitted into the piece, and on each seam its letter and the piece sewn on.
[[nodiscard]] SheetDrawing drawSheet(const Pattern& pattern);

/// About how wide a text in DejaVu Sans is, in mm: enough to keep it inside a piece.
[[nodiscard]] double estimatedWidth(const std::string& utf8, double size);

}  // namespace toile
