// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "finish/polygon.h"
#include "io/ascii.h"
#include "io/dxf_text.h"
#include "io/file_date.h"
#include "io/polyline.h"
#include "toile/core/version.h"
#include "toile/io/nested.h"
#include "toile/sew/sewing.h"

namespace toile {
namespace {

// Layers of ASTM D6673-10.
enum Layer : int {
  kBoundary = 1,
  kTurnPoint = 2,
  kCurvePoint = 3,
  kNotch = 4,
  kReference = 5,
  kMirror = 6,
  kGrain = 7,
  kInternal = 8,
  kCutout = 11,
  kDrill = 13,
  kSew = 14,
  kAnnotation = 15,
  kTNotch = 80,
  kCastleNotch = 81,
  kCheckNotch = 82,
  kUNotch = 83,
  kBoundaryCurve = 84,
  kInternalCurve = 85,
  kCutoutCurve = 86,
  kSewCurve = 87
};

constexpr std::size_t kMostNameChars = 20;  // AccuMark cuts names there
constexpr std::size_t kMostSizeChars = 10;  // name, '_' and size fit the 31 of R12
constexpr double kTextHeightMm = 4;
constexpr double kLeastTextMm = 1.5;
constexpr double kLineFeed = 1.5;    // of the height
constexpr double kLetterWide = 0.8;  // of the height, in the plain fonts of CAD programs
constexpr double kEdgeTextHeightMm = 3.5;

constexpr Layer layerOf(NotchKind kind) {
  switch (kind) {
    case NotchKind::Slit:
    case NotchKind::V:
      return kNotch;
    case NotchKind::T:
      return kTNotch;
    case NotchKind::Castle:
      return kCastleNotch;
    case NotchKind::Check:
      return kCheckNotch;
    case NotchKind::U:
      return kUNotch;
  }
  return kNotch;
}

/// A vertex of a written line.
struct LinePoint {
  DxfPoint at;
  bool corner = false;
};

/// Clockwise, the first point first.
std::vector<LinePoint> clockwise(const Outline& outline, const Placement& placement) {
  std::vector<LinePoint> points;
  for (const OutlinePoint& p : outline)
    points.push_back({toDxf(placement.apply(p.position)), p.corner});
  // A placement never mirrors: the sign of the area is that of the piece's own frame.
  if (signedArea(positions(outline)) > 0 && points.size() > 1)
    std::reverse(points.begin() + 1, points.end());
  return points;
}

std::vector<DxfPoint> coordinates(const std::vector<LinePoint>& points) {
  std::vector<DxfPoint> list;
  list.reserve(points.size());
  for (const LinePoint& p : points) list.push_back(p.at);
  return list;
}

class Writer {
 public:
  Writer(const Pattern& pattern, const DxfOptions& options)
      : pattern_(pattern),
        design_(*pattern.document.design),
        options_(options),
        out_(options.inches) {}

  DxfFile write() { return writeAll({this, 1}, *this); }

  /// Several sizes in one file, with the style text of the base size.
  static DxfFile writeAll(std::span<Writer> sizes, Writer& base) {
    DxfFile file;
    base.out_.section("HEADER");
    if (base.options_.dialect == DxfDialect::Rich) base.writeVariables();
    base.out_.endSection();
    if (base.options_.dialect == DxfDialect::Rich) base.writeTables();
    base.out_.section("BLOCKS");
    const auto take = [&file](Writer& writer) {
      file.text += writer.out_.str();
      writer.out_ = DxfText(writer.options_.inches);
    };
    take(base);
    std::set<std::string> takenSizes;
    for (Writer& size : sizes) {
      size.chooseNames(takenSizes);
      for (std::size_t i = 0; i < size.pattern_.pieces.size(); ++i) size.writeBlock(i);
      take(size);
    }
    base.out_.endSection();
    base.out_.section("ENTITIES");
    take(base);
    for (Writer& size : sizes) {
      size.writeInserts();
      take(size);
    }
    base.writeStyleText();
    base.out_.endSection();
    base.out_.group(0, "EOF");
    take(base);
    for (Writer& size : sizes) {
      for (Finding& finding : size.findings_) {
        const bool isKnown =
            std::find(file.findings.begin(), file.findings.end(), finding) != file.findings.end();
        if (!isKnown) file.findings.push_back(std::move(finding));
      }
    }
    return file;
  }

  std::vector<std::string> blockNames() {
    std::set<std::string> takenSizes;
    chooseNames(takenSizes);
    return std::move(blockNames_);
  }

 private:
  void writeInserts() {
    for (const std::string& name : blockNames_) {
      out_.group(0, "INSERT");
      out_.group(8, kBoundary);
      out_.group(2, name);
      out_.point(10, DxfPoint{});
    }
  }

  [[nodiscard]] bool isAama() const { return options_.dialect == DxfDialect::Aama; }

  void writeVariables() {
    const auto variable = [&](std::string_view name, int code, std::string_view value) {
      out_.group(9, name);
      out_.group(code, value);
    };
    variable("$ACADVER", 1, "AC1009");
    variable("$INSUNITS", 70, options_.inches ? "1" : "4");
    variable("$MEASUREMENT", 70, options_.inches ? "0" : "1");
  }

  /// One line type, a colour per layer, one style of text.
  void writeTables() {
    struct LayerColour {
      int layer, colour;
    };
    constexpr LayerColour kLayers[] = {
        {kBoundary, 7}, {kTurnPoint, 8},  {kCurvePoint, 8}, {kNotch, 1},       {kReference, 8},
        {kMirror, 6},   {kGrain, 3},      {kInternal, 4},   {kCutout, 7},      {kDrill, 1},
        {kSew, 5},      {kAnnotation, 3}, {kTNotch, 1},     {kCastleNotch, 1}, {kCheckNotch, 1},
        {kUNotch, 1},   {84, 9},          {85, 9},          {86, 9},           {87, 9}};
    const auto table = [&](std::string_view name, int count) {
      out_.group(0, "TABLE");
      out_.group(2, name);
      out_.group(70, count);
    };
    out_.section("TABLES");
    table("LTYPE", 1);
    out_.group(0, "LTYPE");
    out_.group(2, "CONTINUOUS");
    out_.group(70, 0);
    out_.group(3, "Solid line");
    out_.group(72, 65);
    out_.group(73, 0);
    out_.group(40, "0.0");
    out_.group(0, "ENDTAB");
    table("LAYER", static_cast<int>(std::size(kLayers)));
    for (const LayerColour& each : kLayers) {
      out_.group(0, "LAYER");
      out_.group(2, each.layer);
      out_.group(70, 0);
      out_.group(62, each.colour);
      out_.group(6, "CONTINUOUS");
    }
    out_.group(0, "ENDTAB");
    table("STYLE", 1);
    out_.group(0, "STYLE");
    out_.group(2, "STANDARD");
    out_.group(70, 0);
    out_.group(40, "0.0");
    out_.group(41, "1.0");
    out_.group(50, "0.0");
    out_.group(71, 0);
    out_.group(42, "2.5");
    out_.group(3, "txt");
    out_.group(4, "");
    out_.group(0, "ENDTAB");
    out_.endSection();
  }

  /// ASCII, and a finding where letters are lost or changed.
  std::string plainText(const std::string& text, const char* what, std::size_t most = 200) {
    std::string ascii = toAscii(text);
    if (ascii.size() > most) ascii.resize(most);
    if (ascii != text && reported_.insert(text).second)
      findings_.push_back({"dxf-text-changed",
                           fmt::format("the DXF, which holds only ASCII, calls the {} \"{}\" "
                                       "\"{}\"; PDF, SVG and reports keep the name",
                                       what, text, ascii),
                           {}});
    return ascii;
  }

  /// Whether the plain name says all that the given one does, case and punctuation aside.
  static bool isWhole(const std::string& given, const std::string& plain) {
    return toAscii(given) == given && toPlainName(given, given.size()) == plain;
  }

  /// What a piece is called where nothing of its name is left: by its id, which has plain letters.
  static std::string plainNameOf(const PatternPiece& piece) {
    std::string name = toPlainName(piece.name, kMostNameChars);
    if (name.empty()) name = toPlainName(piece.id, kMostNameChars);
    return name.empty() ? fmt::format("PIECE-{}", piece.number) : name;
  }

  /// `takenSizes`: by other sizes in the file; two sizes of a piece must not share a block's name.
  void chooseSize(std::set<std::string>& takenSizes) {
    // Some readers refuse a piece without a size.
    const std::string& wanted = design_.order.size;
    const std::string plain = toPlainName(wanted, kMostSizeChars);
    size_ = makeUnique(plain.empty() ? "ONE" : plain, kMostSizeChars, takenSizes);
    // One that is cut short, such as "made to measure", still says what it is.
    if (!wanted.empty() && (plain.empty() || size_ != plain))
      findings_.push_back({"dxf-size-changed",
                           fmt::format("the DXF calls the size \"{}\" {}: sizes there have at most "
                                       "{} plain characters; PDF, SVG and reports keep the name",
                                       wanted, size_, kMostSizeChars),
                           {}});
  }

  void chooseNames(std::set<std::string>& takenSizes) {
    const std::string style = design_.order.style.empty() ? design_.name : design_.order.style;
    style_ = plainText(style, "style", kMostNameChars);
    chooseSize(takenSizes);
    std::set<std::string> taken;
    for (const PatternPiece& piece : pattern_.pieces) {
      const std::string name = makeUnique(plainNameOf(piece), kMostNameChars, taken);
      pieceNames_.push_back(name);
      blockNames_.push_back(name + "_" + size_);
      if (!isWhole(piece.name, name))
        findings_.push_back({"dxf-name-changed",
                             fmt::format("the DXF calls the piece \"{}\" {}: names there have at "
                                         "most {} plain characters and differ from each other",
                                         piece.name, name, kMostNameChars),
                             {Element::piece(piece.id)}});
    }
  }

  void collectPoints(const std::vector<LinePoint>& points) {
    for (const LinePoint& p : points) {
      bool& corner = markedPoints_[p.at];
      corner = corner || p.corner;
    }
  }

  /// An inner line that ends on an outline makes no corner there.
  void collectInnerPoints(const std::vector<LinePoint>& points) {
    for (const LinePoint& p : points) markedPoints_.try_emplace(p.at, p.corner);
  }

  void writeClosed(const Outline& outline, const Placement& placement, int layer, int curveLayer) {
    const std::vector<LinePoint> points = clockwise(outline, placement);
    collectPoints(points);
    out_.polyline(layer, coordinates(points), true);
    curves_.push_back({curveLayer, coordinates(points), true});
  }

  /// Its name stands at its first point, as the standard has it, and along it, so that it stays in
  /// the piece; open lines run to the right.
  void writeInternal(InternalLine line, const Placement& placement) {
    for (Eigen::Vector2d& p : line.points) p = placement.apply(p);
    if (!line.closed && !line.points.empty() && line.points.front().x() > line.points.back().x())
      std::reverse(line.points.begin(), line.points.end());
    std::vector<LinePoint> points;
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i < count; ++i) {
      const bool isEnd = !line.closed && (i == 0 || i + 1 == count);
      const bool turns =
          !isEnd && std::abs(turnAngle(line.points[(i + count - 1) % count], line.points[i],
                                       line.points[(i + 1) % count])) > 0.35;  // 20 degrees
      points.push_back({toDxf(line.points[i]), isEnd || turns});
    }
    collectInnerPoints(points);
    out_.polyline(kInternal, coordinates(points), line.closed);
    curves_.push_back({kInternalCurve, coordinates(points), line.closed});
    if (points.empty()) return;
    const std::string name = plainText(line.name, "line");
    const double length = lengthOf(line.points);
    const double height = std::clamp(length / (kLetterWide * static_cast<double>(name.size() + 1)),
                                     kLeastTextMm, kEdgeTextHeightMm);
    const double width = kLetterWide * height * static_cast<double>(name.size());
    if (name.empty() || width > length) return;  // it would stand out of the piece
    const Eigen::Vector2d along = pointAt(line.points, width) - line.points.front();
    out_.text(kInternal, points.front().at, height, name, std::atan2(along.y(), along.x()));
  }

  void writePieceText(std::size_t i) {
    const PatternPiece& piece = pattern_.pieces[i];
    std::vector<std::string> lines{"Piece Name:" + pieceNames_[i], "Size:" + size_,
                                   fmt::format("Quantity:{},0", piece.count)};
    if (!piece.fabric.empty()) lines.push_back("Material:" + plainText(piece.fabric, "fabric"));
    lines.push_back("Annotation:" + style_);
    lines.emplace_back("Category:");
    writeBesideLabel(i, kBoundary, lines, 0);
  }

  /// Lines of text in the middle of the piece, small enough to stay inside where that can be read;
  /// `above` of them stand above its inmost point.
  void writeBesideLabel(std::size_t i, int layer, const std::vector<std::string>& lines,
                        std::size_t above) {
    const PatternPiece& piece = pattern_.pieces[i];
    std::size_t letters = 1;
    for (const std::string& line : lines) letters = std::max(letters, line.size());
    const double room = EdgeGrid(positions(piece.sewLines)).nearest(piece.labelPosition).distance;
    const double widest = kLetterWide * static_cast<double>(letters);
    const double feeds = 1 + kLineFeed * static_cast<double>(std::max(above, lines.size() - above));
    const double height =
        std::clamp(room / std::hypot(0.5 * widest, feeds), kLeastTextMm, kTextHeightMm);
    Eigen::Vector2d at =
        pattern_.layout.placements[i].apply(piece.labelPosition) +
        height * Eigen::Vector2d(-0.5 * widest, kLineFeed * static_cast<double>(above));
    for (const std::string& line : lines) {
      out_.text(layer, toDxf(at), height, line);
      at.y() -= kLineFeed * height;
    }
  }

  /// What people read on the plotted piece: the label above the system text, and beside each seam
  /// its letter, the same on both pieces that meet there.
  void writeAnnotation(std::size_t i) {
    const PatternPiece& piece = pattern_.pieces[i];
    const Placement& placement = pattern_.layout.placements[i];
    std::vector<std::string> lines;
    for (const std::string& line : piece.label) lines.push_back(plainText(line, "label"));
    writeBesideLabel(i, kAnnotation, lines, lines.size());
    std::vector<Points2> sewLines = positions(piece.sewLines);
    for (Points2& loop : sewLines)
      for (Eigen::Vector2d& p : loop) p = placement.apply(p);
    for (const OutlineRun& run : piece.runs) {
      if (run.seam == 0) continue;
      const std::string codes = edgeCodes(pattern_, piece, run);
      if (const auto place = edgeTextPlace(sewLines, run, codes)) {
        out_.text(kAnnotation, toDxf(place->at), place->height, codes, place->angle);
      }
    }
  }

  struct TextPlace {
    Eigen::Vector2d at;
    double height, angle;
  };

  /// Beside the middle of a run, inside the piece and not upside down; smaller, and away from the
  /// middle, where it would not fit. Nothing where it fits nowhere.
  static std::optional<TextPlace> edgeTextPlace(const std::vector<Points2>& sewLines,
                                                const OutlineRun& run, const std::string& text) {
    const Points2& loop = sewLines[run.loop];
    Points2 way;
    for (std::size_t k = 0; k <= run.edgeCount; ++k)
      way.push_back(loop[(run.first + k) % loop.size()]);
    const double length = lengthOf(way);
    for (const double height : {kEdgeTextHeightMm, 2.5, kLeastTextMm}) {
      const double width = kLetterWide * height * static_cast<double>(text.size());
      if (width > length) continue;
      for (const double part : {0.5, 0.35, 0.65, 0.2, 0.8}) {
        const double middle = std::clamp(part * length, 0.5 * width, length - 0.5 * width);
        const Eigen::Vector2d a = pointAt(way, middle - 0.5 * width);
        const Eigen::Vector2d b = pointAt(way, middle + 0.5 * width);
        if (a == b) continue;
        const Eigen::Vector2d forward = (b - a).normalized();
        const Eigen::Vector2d inward(-forward.y(), forward.x());
        const bool isUpright = forward.x() >= 0;
        const Eigen::Vector2d along = isUpright ? forward : Eigen::Vector2d(-forward);
        const Eigen::Vector2d up(-along.y(), along.x());
        // Clear of the line where it bends inwards beside the text.
        constexpr double kClearMm = 1.5;
        double bulge = 0;
        for (int i = 1; i < 8; ++i)
          bulge = std::max(bulge, (pointAt(way, middle + (i / 8.0 - 0.5) * width) - a).dot(inward));
        const double toBaseline = bulge + kClearMm + (isUpright ? 0 : height);
        const Eigen::Vector2d at = (isUpright ? a : b) + toBaseline * inward;
        bool fits = true;
        for (int i = 0; i <= 8 && fits; ++i)
          for (const double rise : {0.0, height})
            fits = fits && isInside(sewLines, at + i / 8.0 * width * along + rise * up);
        if (fits) return TextPlace{at, height, std::atan2(along.y(), along.x())};
      }
    }
    return std::nullopt;
  }

  void writeBlock(std::size_t i) {
    const PatternPiece& piece = pattern_.pieces[i];
    const Placement& placement = pattern_.layout.placements[i];
    const bool hasAllowance = std::any_of(piece.runs.begin(), piece.runs.end(),
                                          [](const OutlineRun& run) { return run.allowance > 0; });
    markedPoints_.clear();
    curves_.clear();
    out_.group(0, "BLOCK");
    out_.group(8, kBoundary);
    out_.group(2, blockNames_[i]);
    out_.group(70, 0);
    out_.point(10, DxfPoint{});
    out_.group(3, blockNames_[i]);
    writePieceText(i);
    for (std::size_t l = 0; l < piece.cutLines.size(); ++l)
      writeClosed(piece.cutLines[l], placement, l == 0 ? kBoundary : kCutout,
                  l == 0 ? kBoundaryCurve : kCutoutCurve);
    if (hasAllowance)
      for (const Outline& line : piece.sewLines) writeClosed(line, placement, kSew, kSewCurve);
    for (const InternalLine& line : piece.internalLines) writeInternal(line, placement);
    for (const OutlineRun& run : piece.runs)
      if (run.folded) writeInternal(dartLeg(piece, run), placement);
    for (const auto& [at, corner] : markedPoints_) out_.mark(corner ? kTurnPoint : kCurvePoint, at);
    for (const Notch& notch : piece.notches) {
      out_.mark(layerOf(notch.kind), toDxf(placement.apply(notch.position)));
      out_.length(30, notch.depth);
      if (notch.kind != NotchKind::Slit) out_.length(39, notch.width);  // none: a slit
      const Eigen::Vector2d inward = placement.applyToDirection(notch.direction);
      out_.angle(50, std::atan2(inward.y(), inward.x()));
    }
    out_.line(kGrain, toDxf(placement.apply(piece.grain[0])),
              toDxf(placement.apply(piece.grain[1])));
    for (const Eigen::Vector2d& hole : piece.drillHoles)
      out_.mark(kDrill, toDxf(placement.apply(hole)));
    if (piece.fold)
      out_.line(kMirror, toDxf(placement.apply((*piece.fold)[0])),
                toDxf(placement.apply((*piece.fold)[1])));
    if (!isAama()) {
      writeAnnotation(i);
      for (const Curve& curve : curves_) out_.polyline(curve.layer, curve.points, curve.closed);
    }
    out_.group(0, "ENDBLK");
    out_.group(8, kBoundary);
  }

  [[nodiscard]] InternalLine dartLeg(const PatternPiece& piece, const OutlineRun& run) const {
    InternalLine line;
    line.kind = CurveKind::Dart;
    line.curve = run.curve;
    for (const StylingCurve& curve : design_.curves)
      if (curve.id == run.curve) line.name = curve.name;
    const Outline& loop = piece.sewLines[run.loop];
    for (std::size_t k = 0; k <= run.edgeCount; ++k)
      line.points.push_back(loop[(run.first + k) % loop.size()].position);
    return line;
  }

  void writeStyleText() {
    std::vector<std::string> lines{"Style Name:" + style_};
    if (const auto date = fileDate(design_)) {
      lines.push_back(
          fmt::format("Creation Date:{:02}-{:02}-{:04}", date->day, date->month, date->year));
      lines.push_back(fmt::format("Creation Time:{:02}-{:02}", date->hour, date->minute));
    }
    if (isAama()) {
      lines.emplace_back("Author:Toile");
      lines.emplace_back("Product:toile");
      lines.push_back(fmt::format("Version:{}", version()));
    } else {
      lines.push_back(fmt::format("Author:Toile;toile;{}", version()));
    }
    lines.push_back("Sample Size:" + size_);
    lines.emplace_back("Grade Rule Table:");
    lines.emplace_back(options_.inches ? "Units:ENGLISH" : "Units:METRIC");
    if (!isAama()) {
      lines.emplace_back(options_.inches ? "Curve Tolerance:0.002" : "Curve Tolerance:0.05");
      lines.emplace_back("ASTM/D13Proposal 1 Version:D6673-10");
    }
    constexpr double kBelowMm = 24;
    constexpr double kStyleTextMm = 5;
    constexpr double kStyleFeedMm = 8;
    Eigen::Vector2d at = pattern_.layout.min - Eigen::Vector2d(0, kBelowMm);
    for (const std::string& line : lines) {
      out_.text(kBoundary, toDxf(at), kStyleTextMm, line);
      at.y() -= kStyleFeedMm;
    }
  }

  struct Curve {
    int layer;
    std::vector<DxfPoint> points;
    bool closed;
  };

  const Pattern& pattern_;
  const Design& design_;
  DxfOptions options_;
  DxfText out_;
  std::string style_, size_;
  std::vector<std::string> pieceNames_, blockNames_;
  std::map<DxfPoint, bool> markedPoints_;  ///< of the block: vertex -> corner
  std::vector<Curve> curves_;              ///< of the block, for layers 84-87
  std::set<std::string> reported_;
  std::vector<Finding> findings_;
};

}  // namespace

DxfFile writeDxf(const Pattern& pattern, const DxfOptions& options) {
  return Writer(pattern, options).write();
}

std::vector<std::string> dxfBlockNames(const Pattern& pattern) {
  return Writer(pattern, {}).blockNames();
}

DxfFile writeNestedDxf(std::span<const NestedSize> sizes) {
  std::vector<Writer> writers;
  std::size_t base = 0;
  for (const NestedSize& size : sizes) {
    if (size.isBase) base = writers.size();
    writers.emplace_back(*size.pattern, DxfOptions{});
  }
  return Writer::writeAll(writers, writers[base]);
}

}  // namespace toile
