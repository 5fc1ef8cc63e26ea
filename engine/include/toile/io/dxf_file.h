// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/units.h"
#include "toile/layout/pattern.h"

namespace toile {

/// A DXF larger than this is no pattern: a garment in ten sizes takes a few MB.
inline constexpr std::size_t kMostDxfBytes = std::size_t{64} << 20;

/// What a pattern file draws with. Coordinates as they stand in the file, in its own unit.
struct DxfEntity {
  enum class Kind { Polyline, Line, Point, Text };
  Kind kind = Kind::Polyline;
  std::string layer;
  std::vector<Eigen::Vector2d> points;  ///< one of a Point or Text, two of a Line
  bool closed = false;                  ///< of a Polyline, by its flag
  double z = 0;                         ///< of a Point: the depth of a notch, the size of a hole
  std::optional<double> width;          ///< of a Point (39): of a notch
  std::optional<double> angle;          ///< degrees; of a Point (50): of a notch; of a Text
  std::string text;
  double height = 0;  ///< of a Text
  friend bool operator==(const DxfEntity&, const DxfEntity&) = default;
};

/// A piece in one size.
struct DxfBlock {
  std::string name;
  std::vector<DxfEntity> entities;
  friend bool operator==(const DxfBlock&, const DxfBlock&) = default;
};

struct DxfInsert {
  std::string block;
  Eigen::Vector2d at{0, 0};
  Eigen::Vector2d scale{1, 1};
  double angle = 0;  ///< degrees
  friend bool operator==(const DxfInsert&, const DxfInsert&) = default;
};

/// An apparel DXF (AAMA, ASTM D6673) as it was written, in the order of the file.
struct DxfDrawing {
  std::vector<DxfBlock> blocks;  ///< without those of paper and model space
  std::vector<DxfInsert> inserts;
  std::vector<DxfEntity> entities;  ///< beside the inserts
  FileUnit unit = FileUnit::Millimetre;
  std::vector<Finding> findings;  ///< what was left out, guessed or mended
};

/// Reads the dialects that pattern programs write, tolerantly: chains of open runs, repeated first
/// vertices, missing heights and layers, LWPOLYLINE, arcs and circles (as chords within 0.02 mm),
/// any number of decimals, CRLF or LF. What a pattern has no use for is left out with a finding.
///
/// @param unit  where the file does not say it ("Units:" text, $INSUNITS); then the size of its
///   pieces is asked, with a finding.
/// @return FileFormat with the line for a file that is cut off, damaged, binary, or no DXF;
///   Unsupported for one of more than kMostDxfBytes.
/// @par Cost  linear in the bytes; reads on dxflib
Result<DxfDrawing> readDxf(std::string_view text, std::optional<FileUnit> unit = std::nullopt);

/// The same content in the shape of writeDxf(Pattern): R12 entities, no tables, CRLF. Every number
/// reads back bit for bit.
std::string writeDxf(const DxfDrawing& drawing);

/// The pieces of a drawing of one size, as pattern pieces in mm on one sheet, for SVG, PDF and
/// plotters. Outlines are joined from their runs; notch directions are taken from the outline.
///
/// @param size  as the file names it; by default the sample size of the style, or the only one.
/// @return NameNotFound for a size that the file does not have (the message lists those that it
///   has); FileFormat when no block holds a closed outline.
Result<Pattern> patternFrom(const DxfDrawing& drawing, const std::string& name,
                            const std::optional<std::string>& size = std::nullopt);

/// The value of the text "<key>: value" among entities, without its blanks; keys are compared
/// without case.
std::optional<std::string> dxfText(const std::vector<DxfEntity>& entities, std::string_view key);

}  // namespace toile
