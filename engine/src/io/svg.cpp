// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/svg.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>

#include "finish/smoothing.h"
#include "io/markup.h"
#include "render/strain_map.h"

namespace toile {
namespace {

constexpr double kMarginMm = 10;

/// Thousandths of a millimetre, without trailing zeros and never "-0".
std::string number(double mm) {
  const long long value = std::llround(mm * 1000);
  const long long size = value < 0 ? -value : value;
  std::string text = fmt::format("{}{}", value < 0 ? "-" : "", size / 1000);
  if (size % 1000 != 0) {
    text += fmt::format(".{:03}", size % 1000);
    while (text.back() == '0') text.pop_back();
  }
  return text;
}

class Writer {
 public:
  explicit Writer(const SheetDrawing& sheet) : sheet_(sheet), out_(std::back_inserter(text_)) {}
  /// With the strain of the pieces beneath their lines.
  Writer(const SheetDrawing& sheet, const Pattern& pattern, const StrainField& strain)
      : sheet_(sheet), pattern_(&pattern), strain_(&strain), out_(std::back_inserter(text_)) {}

  std::string write() {
    const Eigen::Vector2d size = sheet_.max - sheet_.min + Eigen::Vector2d(2, 2) * kMarginMm;
    fmt::format_to(out_,
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                   "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
                   "version=\"1.1\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n"
                   "<title>{2}</title>\n",
                   number(size.x()), number(size.y()), escaped(sheet_.name));
    writeAround();
    for (std::size_t i = 0; i < sheet_.pieces.size(); ++i) {
      if (strain_ != nullptr) writeStrain(i);
      writePiece(sheet_.pieces[i]);
    }
    if (strain_ != nullptr) text_ += strainLegendSvg(*strain_);
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  /// The sheet's y is up, the file's is down: the one place where it turns.
  [[nodiscard]] Eigen::Vector2d toFile(const Eigen::Vector2d& p) const {
    return {p.x() - sheet_.min.x() + kMarginMm, sheet_.max.y() - p.y() + kMarginMm};
  }

  void writeStrain(std::size_t index) {
    const std::size_t source = pattern_->pieceIndex[index];
    fmt::format_to(out_,
                   "<g inkscape:groupmode=\"layer\" inkscape:label=\"{} strain\" "
                   "stroke-width=\"0.3\" stroke-linejoin=\"round\">\n",
                   escaped(sheet_.pieces[index].name));
    const Placement& placement = pattern_->layout.placements[index];
    for (const StrainShade& shade :
         strainShades(*strain_, *pattern_, source,
                      [&](const Eigen::Vector2d& p) { return toFile(placement.apply(p)); })) {
      fmt::format_to(out_, "<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", toHex(shade.colour),
                     shade.path);
    }
    text_ += "</g>\n";
  }

  void writePiece(const PieceDrawing& drawing) {
    fmt::format_to(out_,
                   "<g id=\"piece-{0}\" inkscape:groupmode=\"layer\" inkscape:label=\"{1}\" "
                   "data-piece=\"{0}\" data-number=\"{2}\" data-count=\"{3}\" data-fabric=\"{4}\" "
                   "fill=\"none\" stroke=\"black\" stroke-linejoin=\"round\">\n",
                   escaped(drawing.id), escaped(drawing.name), drawing.number, drawing.count,
                   escaped(drawing.fabric));
    for (const SheetRole role :
         {SheetRole::Cut, SheetRole::Sew, SheetRole::Internal, SheetRole::Notch, SheetRole::Drill,
          SheetRole::Grain, SheetRole::Text}) {
      fmt::format_to(out_, "<g inkscape:groupmode=\"layer\" inkscape:label=\"{} {}\">\n",
                     escaped(drawing.name), layerName(role));
      writeRole(drawing, role);
      text_ += "</g>\n";
    }
    text_ += "</g>\n";
  }

  void writeRole(const PieceDrawing& drawing, SheetRole role) {
    for (const SheetLine& line : drawing.lines)
      if (line.role == role) writeLine(line);
    for (const SheetText& text : drawing.texts)
      if (text.role == role) writeText(text);
  }

  /// A marker's material.
  void writeAround() {
    if (sheet_.around.lines.empty() && sheet_.around.texts.empty()) return;
    fmt::format_to(out_,
                   "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" fill=\"none\" "
                   "stroke=\"black\">\n",
                   layerName(SheetRole::Material));
    writeRole(sheet_.around, SheetRole::Material);
    text_ += "</g>\n";
  }

  void writeLine(const SheetLine& line) {
    if (line.pen.width > 0) {
      fmt::format_to(out_, "<path stroke-width=\"{}\"", number(line.pen.width));
    } else {
      text_ += "<path stroke=\"none\"";
    }
    if (!line.pen.dash.empty()) {
      text_ += " stroke-dasharray=\"";
      for (std::size_t i = 0; i < line.pen.dash.size(); ++i)
        fmt::format_to(out_, "{}{}", i == 0 ? "" : " ", number(line.pen.dash[i]));
      text_ += '"';
    }
    if (!line.kind.empty()) fmt::format_to(out_, " data-kind=\"{}\"", escaped(line.kind));
    if (!line.curve.empty()) fmt::format_to(out_, " data-curve=\"{}\"", escaped(line.curve));
    if (line.seam != 0)
      fmt::format_to(out_, " data-{}=\"{}\"", line.role == SheetRole::Notch ? "notch" : "seam",
                     line.seam);
    if (!line.mate.empty()) fmt::format_to(out_, " data-mate=\"{}\"", escaped(line.mate));
    if (!line.edge.empty()) fmt::format_to(out_, " data-edge=\"{}\"", escaped(line.edge));
    text_ += " d=\"";
    writeWay(line);
    text_ += line.closed ? " Z\"/>\n" : "\"/>\n";
  }

  /// Chords, and circular arcs of the same length where several follow one.
  void writeWay(const SheetLine& line) {
    Points2 points = line.points;
    if (line.closed) points.push_back(points.front());
    const Eigen::Vector2d start = toFile(points.front());
    fmt::format_to(out_, "M{} {}", number(start.x()), number(start.y()));
    std::vector<std::size_t> ends = line.arcEnds;
    if (ends.empty()) ends = arcEnds(points, line.role == SheetRole::Cut);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const auto part = std::span(points).subspan(ends[k], ends[k + 1] - ends[k] + 1);
      const std::optional<EqualArc> arc =
          part.size() > 2 ? equalArc(part) : std::optional<EqualArc>();
      if (!arc || arc->radius == 0) {
        // The last chord of a closed line is its "Z".
        const bool closes = line.closed && ends[k + 1] + 1 == points.size();
        for (const Eigen::Vector2d& p : part.subspan(1, part.size() - (closes ? 2 : 1))) lineTo(p);
      } else {
        const Eigen::Vector2d p = toFile(part.back());
        // Down the page is the file's y: what turns left on the sheet turns left on the screen.
        fmt::format_to(out_, " A{0} {0} 0 0 {1} {2} {3}", number(arc->radius), arc->toLeft ? 0 : 1,
                       number(p.x()), number(p.y()));
      }
    }
  }

  void lineTo(const Eigen::Vector2d& p) {
    const Eigen::Vector2d q = toFile(p);
    fmt::format_to(out_, " L{} {}", number(q.x()), number(q.y()));
  }

  /// Where arcs may begin and end on a line that has no mate.
  static std::vector<std::size_t> arcEnds(const Points2& points, bool isCurved) {
    constexpr double kCorner = 20 * std::numbers::pi / 180;
    constexpr std::size_t kMost = 64;
    std::vector<std::size_t> ends{0};
    while (ends.back() + 1 < points.size()) {
      const std::size_t from = ends.back();
      std::size_t to = from + 1;
      while (isCurved && to + 1 < points.size() && to - from < kMost &&
             std::abs(turnAngle(points[to - 1], points[to], points[to + 1])) < kCorner &&
             equalArc(std::span(points).subspan(from, to - from + 2)))
        ++to;
      ends.push_back(to);
    }
    return ends;
  }

  void writeText(const SheetText& text) {
    const Eigen::Vector2d p = toFile(text.position);
    fmt::format_to(out_, "<text x=\"{}\" y=\"{}\"", number(p.x()), number(p.y()));
    const double degrees = -text.angle * 180 / std::numbers::pi;
    if (degrees != 0)
      fmt::format_to(out_, " transform=\"rotate({} {} {})\"", number(degrees), number(p.x()),
                     number(p.y()));
    fmt::format_to(out_,
                   " font-family=\"DejaVu Sans, sans-serif\" font-size=\"{}\"{} "
                   "text-anchor=\"middle\" fill=\"black\" stroke=\"none\">{}</text>\n",
                   number(text.size), text.bold ? " font-weight=\"bold\"" : "", escaped(text.text));
  }

  const SheetDrawing& sheet_;
  const Pattern* pattern_ = nullptr;
  const StrainField* strain_ = nullptr;
  std::string text_;
  std::back_insert_iterator<std::string> out_;
};

}  // namespace

std::string writeSvg(const SheetDrawing& sheet) {
  return Writer(sheet).write();
}

std::string writeStrainSvg(const Pattern& pattern) {
  const StrainField strain(pattern, StrainMap::Area);
  return Writer(drawSheet(pattern), pattern, strain).write();
}

}  // namespace toile
