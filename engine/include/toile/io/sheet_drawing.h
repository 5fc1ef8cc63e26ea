// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile {

/// What a line or text of a sheet is; SVG has a layer for each.
enum class SheetRole { Cut, Sew, Internal, Notch, Drill, Grain, Text, Material };
[[nodiscard]] const char* layerName(SheetRole role);

/// How a line is drawn.
struct Pen {
  double width = 0.3;        ///< mm; 0 = there, but not drawn
  std::vector<double> dash;  ///< mm: on, off, ...; empty = solid
};

/// A line on the sheet: mm, y up.
struct SheetLine {
  SheetRole role = SheetRole::Cut;
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
  Pen pen;
  std::string curve;                   ///< id of the styling curve, if it is one curve's
  std::string kind;                    ///< of the wire or internal line
  int seam = 0;                        ///< number of the seam, 0 = none
  std::string mate;                    ///< id of the piece sewn on
  std::string edge;                    ///< codes of a sewn edge and its mate
  bool isCut = false;                  ///< by a machine: cut lines, and notches but those drawn
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
  int number = 1;
  int count = 1;  ///< to cut
  std::string fabric;
  std::vector<SheetLine> lines;
  std::vector<SheetText> texts;
};

/// A sheet of paper or cloth as all vector formats draw it: writeSvg(), writePdf(), writeHpgl(),
/// writeLaserDxf().
struct SheetDrawing {
  std::string name;     ///< of the design
  std::string heading;  ///< style, size, customer, date
  std::string date;     ///< "2026-01-31T00:00:00Z", or empty: files then have none
  std::vector<PieceDrawing> pieces;
  /// What is no piece: the edges and faults of a marker's material, its figures.
  PieceDrawing around;
  bool isMarker = false;                          ///< x runs along the roll
  Eigen::Vector2d min = Eigen::Vector2d::Zero();  ///< box of the cut lines and the material, mm
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
};

/// All pieces where the layout puts them: cut lines, sew lines by seam, feature lines with names,
/// notches with numbers, the grain line, the label fitted into the piece, and on each seam its
/// letter and the piece sewn on.
[[nodiscard]] SheetDrawing drawSheet(const Pattern& pattern);

/// A sheet for pieces to come, with what the design tells of it.
[[nodiscard]] SheetDrawing makeEmptySheet(const Design& design);
/// One piece.
/// @param pattern  where its mates are
/// @param piece    one of the pattern's, perhaps turned over
[[nodiscard]] PieceDrawing drawPiece(const Pattern& pattern, const PatternPiece& piece,
                                     const Placement& placement);
/// Sets the box of a sheet by its lines.
void fitBox(SheetDrawing& sheet);

/// About how wide a text in DejaVu Sans is, in mm: enough to keep it inside a piece.
[[nodiscard]] double estimatedWidth(const std::string& utf8, double size);

}  // namespace toile
