// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/render_sheet.h"

#include <cairo.h>
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "io/drawing_style.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kMargin = 34;        // px of the style, round the pieces
constexpr double kScaleBarRoom = 26;  // px of the style, below them
constexpr double kLabelSize = 11.5;   // px of the style
constexpr double kLeastLabelSize = 7;

struct CairoEnd {
  void operator()(cairo_t* c) const { cairo_destroy(c); }
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  void operator()(PangoLayout* l) const { g_object_unref(l); }
};
using Cairo = std::unique_ptr<cairo_t, CairoEnd>;

Cairo drawOn(Picture& picture) {
  const std::unique_ptr<cairo_surface_t, CairoEnd> surface(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(picture.pixels.data()), CAIRO_FORMAT_RGB24, picture.width,
      picture.height, 4 * picture.width));
  return Cairo(cairo_create(surface.get()));
}

void setColour(cairo_t* cairo, Colour colour, double opacity = 1) {
  cairo_set_source_rgba(cairo, colour.r / 255.0, colour.g / 255.0, colour.b / 255.0, opacity);
}

/// Millimetres on the sheet to pixels.
struct SheetFrame {
  double pixelsPerMm = 1;
  Vector2d origin = Vector2d::Zero();  ///< px of the sheet's (0, 0)
  double scale = 1;                    ///< px per px of the styles
  [[nodiscard]] Vector2d at(const Vector2d& mm) const {
    return {origin.x() + pixelsPerMm * mm.x(), origin.y() - pixelsPerMm * mm.y()};
  }
};

void setStroke(cairo_t* cairo, const LineStyle& style, double scale) {
  setColour(cairo, style.colour);
  cairo_set_line_width(cairo, style.width * scale);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cairo, style.dash == Dash::Dots ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  std::vector<double> dashes;
  if (style.dash == Dash::Dashes) dashes = {kDashOn, kDashOff};
  if (style.dash == Dash::Dots) dashes = {0.01, kDotSpacing};
  if (style.dash == Dash::LongShort) dashes = {kLongOn, kLongOff, kLongOff, kLongOff};
  for (double& length : dashes) length *= scale;
  cairo_set_dash(cairo, dashes.data(), static_cast<int>(dashes.size()), 0);
}

class SheetPainter {
 public:
  SheetPainter(cairo_t* cairo, SheetFrame frame) : cairo_(cairo), frame_(frame) {}

  void paint(const PatternPiece& piece, const Placement& placement, Colour tint) {
    placement_ = &placement;
    addOutlines(piece.cutLines);
    setColour(cairo_, {255, 255, 255});
    cairo_fill_preserve(cairo_);
    setStroke(cairo_, {kCutLine, Dash::Solid, 0.9}, frame_.scale);
    cairo_stroke(cairo_);
    addOutlines(piece.sewLines);
    setColour(cairo_, tint);
    cairo_fill(cairo_);
    for (const InternalLine& line : piece.internalLines) paintInternal(line);
    for (const OutlineRun& run : piece.runs) paintRun(piece, run);
    for (const Notch& notch : piece.notches) paintNotch(notch);
    paintGrain(piece);
    paintLabel(piece);
  }

 private:
  [[nodiscard]] Vector2d at(const Vector2d& p) const { return frame_.at(placement_->apply(p)); }
  void moveTo(const Vector2d& p) { cairo_move_to(cairo_, at(p).x(), at(p).y()); }
  void lineTo(const Vector2d& p) { cairo_line_to(cairo_, at(p).x(), at(p).y()); }

  void addOutlines(const std::vector<Outline>& outlines) {
    cairo_new_path(cairo_);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
    for (const Outline& outline : outlines) {
      if (outline.empty()) continue;
      moveTo(outline.front().position);
      for (const OutlinePoint& point : outline) lineTo(point.position);
      cairo_close_path(cairo_);
    }
  }

  void paintInternal(const InternalLine& line) {
    if (line.points.empty()) return;
    cairo_new_path(cairo_);
    moveTo(line.points.front());
    for (const Vector2d& p : line.points) lineTo(p);
    if (line.closed) cairo_close_path(cairo_);
    LineStyle style = lineStyle(line.kind);
    style.width *= 0.75;  // the sheet's lines are finer than the model's
    setStroke(cairo_, style, frame_.scale * 0.8);
    cairo_stroke(cairo_);
  }

  void paintRun(const PatternPiece& piece, const OutlineRun& run) {
    if (run.loop >= piece.sewLines.size()) return;
    const Outline& outline = piece.sewLines[run.loop];
    if (outline.empty()) return;
    cairo_new_path(cairo_);
    moveTo(outline[run.first % outline.size()].position);
    for (std::size_t i = 1; i <= run.edgeCount; ++i) {
      lineTo(outline[(run.first + i) % outline.size()].position);
    }
    LineStyle style = lineStyle(run.kind);
    style.width = run.kind == WireKind::Border ? 1.3 : 1.7;
    setStroke(cairo_, style, frame_.scale);
    cairo_stroke(cairo_);
  }

  void paintNotch(const Notch& notch) {
    cairo_new_path(cairo_);
    moveTo(notch.position);
    lineTo(notch.position + notch.depth * notch.direction);
    setStroke(cairo_, {kText, Dash::Solid, 1.1}, frame_.scale);
    cairo_stroke(cairo_);
  }

  void paintGrain(const PatternPiece& piece) {
    const Vector2d low = at(piece.grain[0]);
    const Vector2d high = at(piece.grain[1]);
    const double length = (high - low).norm();
    if (length < 12 * frame_.scale) return;
    const Vector2d along = (high - low) / length;
    const Vector2d across(-along.y(), along.x());
    cairo_new_path(cairo_);
    cairo_move_to(cairo_, low.x(), low.y());
    cairo_line_to(cairo_, high.x(), high.y());
    const double barb = 4 * frame_.scale;
    for (const auto& [tip, sign] : {std::pair(low, 1.0), std::pair(high, -1.0)}) {
      for (const double side : {-0.6, 0.6}) {
        const Vector2d end = tip + barb * (sign * along + side * across);
        cairo_move_to(cairo_, tip.x(), tip.y());
        cairo_line_to(cairo_, end.x(), end.y());
      }
    }
    setStroke(cairo_, {kSecondText, Dash::Solid, 1.0}, frame_.scale);
    cairo_stroke(cairo_);
  }

  void paintLabel(const PatternPiece& piece);

  cairo_t* cairo_;
  SheetFrame frame_;
  const Placement* placement_ = nullptr;
};

/// Width and height of a line of text whose origin is the left end of its base line.
class TextLine {
 public:
  TextLine(cairo_t* cairo, const std::string& text, double size, bool bold)
      : layout_(pango_cairo_create_layout(cairo)) {
    PangoFontDescription* font = pango_font_description_from_string("Inter,Noto Sans,DejaVu Sans");
    pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
    pango_font_description_set_weight(font, bold ? PANGO_WEIGHT_SEMIBOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout_.get(), font);
    pango_font_description_free(font);
    pango_layout_set_text(layout_.get(), text.c_str(), static_cast<int>(text.size()));
  }
  [[nodiscard]] double width() const {
    int width = 0;
    pango_layout_get_pixel_size(layout_.get(), &width, nullptr);
    return width;
  }
  /// With a pale rim, so that lines beneath do not disturb reading.
  void drawWithHalo(cairo_t* cairo, double x, double y, double rim) const {
    cairo_new_path(cairo);
    cairo_move_to(cairo, x,
                  y - static_cast<double>(pango_layout_get_baseline(layout_.get())) / PANGO_SCALE);
    pango_cairo_layout_path(cairo, layout_.get());
    cairo_set_dash(cairo, nullptr, 0, 0);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, 2 * rim);
    cairo_set_source_rgba(cairo, 1, 1, 1, 0.6);
    cairo_stroke_preserve(cairo);
    setColour(cairo, kText);
    cairo_fill(cairo);
  }
  void draw(cairo_t* cairo, double x, double y) const {
    cairo_move_to(cairo, x,
                  y - static_cast<double>(pango_layout_get_baseline(layout_.get())) / PANGO_SCALE);
    pango_cairo_show_layout(cairo, layout_.get());
  }

 private:
  std::unique_ptr<PangoLayout, CairoEnd> layout_;
};

/// The stretch of the horizontal line through a point that lies inside the outlines around it, px.
std::array<double, 2> roomAround(const std::vector<std::vector<Vector2d>>& loops,
                                 const Vector2d& point) {
  std::array<double, 2> room = {-1e300, 1e300};
  for (const std::vector<Vector2d>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d& a = loop[i];
      const Vector2d& b = loop[(i + 1) % loop.size()];
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (x <= point.x()) room[0] = std::max(room[0], x);
      if (x > point.x()) room[1] = std::min(room[1], x);
    }
  }
  return room;
}

void SheetPainter::paintLabel(const PatternPiece& piece) {
  if (piece.name.empty() || piece.sewLines.empty()) return;
  std::vector<std::vector<Vector2d>> loops;
  for (const Outline& outline : piece.sewLines) {
    loops.emplace_back();
    for (const OutlinePoint& point : outline) loops.back().push_back(at(point.position));
  }
  Vector2d middle = at(piece.labelPosition);
  const auto [left, right] = roomAround(loops, middle);
  if (left < -1e299 || right > 1e299) return;
  double size = kLabelSize * frame_.scale;
  double width = TextLine(cairo_, piece.name, size, false).width();
  const double room = 0.86 * (right - left);
  if (width > room) {
    size = std::max(size * room / width, kLeastLabelSize * frame_.scale);
    width = TextLine(cairo_, piece.name, size, false).width();
  }
  const double slack = std::max(0.0, (right - left - width) / 2);
  middle.x() =
      std::clamp(middle.x(), left + width / 2 + 0.2 * slack,
                 std::max(right - width / 2 - 0.2 * slack, left + width / 2 + 0.2 * slack));
  const TextLine text(cairo_, piece.name, size, false);
  text.drawWithHalo(cairo_, middle.x() - width / 2, middle.y() + size / 3, 2.5 * frame_.scale);
}

/// The largest of 10, 20, 50, 100, ... mm that takes at most that many.
double roundLength(double mm) {
  const double power = std::pow(10.0, std::floor(std::log10(mm)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= mm) return step * power;
  }
  return power;
}

void drawScaleBar(cairo_t* cairo, const PixelBox& box, const SheetFrame& frame) {
  const double mm = roundLength(std::max(1e-3, 0.22 * box.width / frame.pixelsPerMm));
  const double length = mm * frame.pixelsPerMm;
  const double left = box.x + box.width - kMargin * frame.scale - length;
  const double y = box.y + box.height - 20 * frame.scale;
  const double tick = 4 * frame.scale;
  cairo_new_path(cairo);
  cairo_move_to(cairo, left, y - tick);
  cairo_line_to(cairo, left, y);
  cairo_line_to(cairo, left + length, y);
  cairo_line_to(cairo, left + length, y - tick);
  setStroke(cairo, {kSecondText, Dash::Solid, 1.1}, frame.scale);
  cairo_stroke(cairo);
  const TextLine text(cairo, fmt::format("{:g} mm", mm), 11 * frame.scale, false);
  setColour(cairo, kSecondText);
  text.draw(cairo, left + (length - text.width()) / 2, y - 5 * frame.scale);
}

}  // namespace

void drawSheet(Picture& picture, const PixelBox& box, const Pattern& pattern, double scale) {
  const Cairo cairo = drawOn(picture);
  cairo_rectangle(cairo.get(), box.x, box.y, box.width, box.height);
  cairo_clip_preserve(cairo.get());
  setColour(cairo.get(), kSheet);
  cairo_fill(cairo.get());

  const Vector2d size = (pattern.layout.max - pattern.layout.min).cwiseMax(1e-6);
  SheetFrame frame;
  frame.scale = scale;
  const double width = std::max(1.0, box.width - 2 * kMargin * scale);
  const double height = std::max(1.0, box.height - (2 * kMargin + kScaleBarRoom) * scale);
  frame.pixelsPerMm = std::min(width / size.x(), height / size.y());
  const Vector2d middle = 0.5 * (pattern.layout.min + pattern.layout.max);
  frame.origin = {
      box.x + box.width / 2.0 - frame.pixelsPerMm * middle.x(),
      box.y + (box.height - kScaleBarRoom * scale) / 2.0 + frame.pixelsPerMm * middle.y()};

  const std::vector<Colour> tints = pieceColours(pattern.cut);
  SheetPainter painter(cairo.get(), frame);
  for (std::size_t i = 0; i < pattern.pieces.size() && i < pattern.layout.placements.size(); ++i) {
    painter.paint(pattern.pieces[i], pattern.layout.placements[i], tints[pattern.pieceIndex[i]]);
  }
  if (!pattern.pieces.empty()) drawScaleBar(cairo.get(), box, frame);
}

void drawCaption(Picture& picture, const Caption& caption) {
  const Cairo cairo = drawOn(picture);
  const TextLine text(cairo.get(), caption.text, caption.size, caption.bold);
  setColour(cairo.get(), caption.bold ? kText : kSecondText);
  text.draw(cairo.get(), caption.centred ? caption.x - text.width() / 2 : caption.x, caption.y);
}

}  // namespace toile
