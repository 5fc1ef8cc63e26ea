// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "io/markup.h"
#include "toile/io/nested.h"
#include "toile/io/sheet_drawing.h"

namespace toile {

namespace {

constexpr double kMarginMm = 10;
constexpr double kKeyLineMm = 8;
/// Of the sizes beside the base, in turn; apart also for those who do not see red and green apart.
constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#56b4e9", "#e69f00", "#7a4fa3", "#8c6d31"};

std::string number(double mm) {
  return fmt::format("{}", std::round(mm * 1000) / 1000 + 0.0);
}

class Writer {
 public:
  explicit Writer(std::span<const NestedSize> sizes)
      : sizes_(sizes), out_(std::back_inserter(text_)) {
    for (const NestedSize& size : sizes) {
      sheets_.push_back(drawSheet(*size.pattern));
      min_ = min_.cwiseMin(sheets_.back().min);
      max_ = max_.cwiseMax(sheets_.back().max);
    }
    key_ = kKeyLineMm * (static_cast<double>(sizes.size()) + 1);
  }

  std::string write() {
    const Eigen::Vector2d size = max_ - min_ + Eigen::Vector2d(2 * kMarginMm, 2 * kMarginMm + key_);
    const std::string& title = sizes_.front().pattern->document.design->name;
    fmt::format_to(out_,
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                   "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
                   "version=\"1.1\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n"
                   "<title>{2}</title>\n",
                   number(size.x()), number(size.y()), escaped(title));
    std::size_t next = 0;
    for (std::size_t s = 0; s < sizes_.size(); ++s) {
      const bool isBase = sizes_[s].isBase;
      const char* colour = isBase ? "black" : kColours[next++ % kColours.size()];
      fmt::format_to(out_,
                     "<g id=\"size-{0}\" inkscape:groupmode=\"layer\" inkscape:label=\"{0}\" "
                     "data-size=\"{0}\" data-base=\"{1}\" fill=\"none\" stroke=\"{2}\" "
                     "stroke-linejoin=\"round\">\n",
                     escaped(sizes_[s].name), isBase ? "yes" : "no", colour);
      for (const PieceDrawing& piece : sheets_[s].pieces) writePiece(piece, isBase);
      writeKey(s, colour);
      text_ += "</g>\n";
    }
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  [[nodiscard]] Eigen::Vector2d toFile(const Eigen::Vector2d& p) const {
    return {p.x() - min_.x() + kMarginMm, max_.y() - p.y() + kMarginMm + key_};
  }

  void writePiece(const PieceDrawing& piece, bool isBase) {
    fmt::format_to(out_, "<g data-piece=\"{}\">\n", escaped(piece.id));
    for (const SheetLine& line : piece.lines) {
      if (line.role != SheetRole::Cut && !isBase) continue;
      fmt::format_to(out_, "<path stroke-width=\"{}\" data-role=\"{}\" d=\"",
                     number(line.role == SheetRole::Cut && isBase ? 0.5 : 0.3),
                     layerName(line.role));
      for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Eigen::Vector2d p = toFile(line.points[i]);
        fmt::format_to(out_, "{}{} {}", i == 0 ? "M" : " L", number(p.x()), number(p.y()));
      }
      text_ += line.closed ? " Z\"/>\n" : "\"/>\n";
    }
    for (const SheetText& text : piece.texts) {
      if (isBase) writeText(toFile(text.position), text.angle, text.size, text.text, "middle");
    }
    text_ += "</g>\n";
  }

  void writeText(const Eigen::Vector2d& p, double angle, double size, const std::string& text,
                 const char* anchor) {
    fmt::format_to(out_, "<text x=\"{}\" y=\"{}\"", number(p.x()), number(p.y()));
    if (angle != 0) {
      fmt::format_to(out_, " transform=\"rotate({} {} {})\"",
                     number(-angle * 180 / std::numbers::pi), number(p.x()), number(p.y()));
    }
    fmt::format_to(out_,
                   " font-family=\"DejaVu Sans, sans-serif\" font-size=\"{}\" text-anchor=\"{}\" "
                   "fill=\"black\" stroke=\"none\">{}</text>\n",
                   number(size), anchor, escaped(text));
  }

  void writeKey(std::size_t s, const char* colour) {
    const double y = kMarginMm + kKeyLineMm * (static_cast<double>(s) + 0.5);
    fmt::format_to(out_, "<path stroke=\"{}\" stroke-width=\"{}\" d=\"M{} {} h 30\"/>\n", colour,
                   sizes_[s].isBase ? "0.5" : "0.3", number(kMarginMm), number(y));
    writeText({kMarginMm + 34, y + 1.5}, 0, 5,
              sizes_[s].name + (sizes_[s].isBase ? " (base size)" : ""), "start");
  }

  std::span<const NestedSize> sizes_;
  std::vector<SheetDrawing> sheets_;
  Eigen::Vector2d min_ = Eigen::Vector2d::Constant(1e9), max_ = Eigen::Vector2d::Constant(-1e9);
  double key_ = 0;  ///< mm, its height
  std::string text_;
  std::back_insert_iterator<std::string> out_;
};

}  // namespace

std::string writeNestedSvg(std::span<const NestedSize> sizes) {
  return Writer(sizes).write();
}

}  // namespace toile
