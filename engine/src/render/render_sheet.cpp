// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/render_sheet.h"

#include <cairo.h>
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/drawing_style.h"
#include "render/label_fit.h"
#include "render/panel_colours.h"
#include "render/strain_map.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kMargin = 34;        // px of the style, round the pieces
constexpr double kScaleBarRoom = 26;  // px of the style, below them
constexpr double kLabelSize = 11;     // px of the style
constexpr double kLeastLabelSize = 5;

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

/// A block of text, its lines centred under each other.
class TextBlock {
 public:
  TextBlock(cairo_t* cairo, const std::string& text, double size, bool bold)
      : layout_(pango_cairo_create_layout(cairo)) {
    PangoFontDescription* font = pango_font_description_from_string("Inter,Noto Sans,DejaVu Sans");
    pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
    pango_font_description_set_weight(font, bold ? PANGO_WEIGHT_SEMIBOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout_.get(), font);
    pango_font_description_free(font);
    pango_layout_set_alignment(layout_.get(), PANGO_ALIGN_CENTER);
    pango_layout_set_text(layout_.get(), text.c_str(), static_cast<int>(text.size()));
  }
  [[nodiscard]] Vector2d size() const {
    int width = 0;
    int height = 0;
    pango_layout_get_size(layout_.get(), &width, &height);
    return Vector2d(width, height) / PANGO_SCALE;
  }
  /// From the left end of the first base line.
  void draw(cairo_t* cairo, double x, double y) const {
    cairo_move_to(cairo, x,
                  y - static_cast<double>(pango_layout_get_baseline(layout_.get())) / PANGO_SCALE);
    pango_cairo_show_layout(cairo, layout_.get());
  }
  /// Round its middle, turned, with a pale rim where lines may run beneath.
  void drawRound(cairo_t* cairo, const Vector2d& middle, double angle, double rim) const {
    cairo_save(cairo);
    cairo_translate(cairo, middle.x(), middle.y());
    cairo_rotate(cairo, angle);
    cairo_new_path(cairo);
    cairo_move_to(cairo, -size().x() / 2, -size().y() / 2);
    pango_cairo_layout_path(cairo, layout_.get());
    cairo_set_dash(cairo, nullptr, 0, 0);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, 2 * rim);
    cairo_set_source_rgba(cairo, 1, 1, 1, 0.5);
    cairo_stroke_preserve(cairo);
    setColour(cairo, kText);
    cairo_fill(cairo);
    cairo_restore(cairo);
  }

 private:
  std::unique_ptr<PangoLayout, CairoEnd> layout_;
};

/// The words of a name in one line, in two of about the same length, and each in its own.
std::vector<std::string> waysToBreak(const std::string& name) {
  std::vector<std::string> ways = {name};
  std::size_t best = std::string::npos;
  const auto unevenness = [&](std::size_t at) {
    return std::max(at, name.size() - at) - std::min(at, name.size() - at);
  };
  for (std::size_t at = name.find(' '); at != std::string::npos; at = name.find(' ', at + 1)) {
    if (best == std::string::npos || unevenness(at) < unevenness(best)) best = at;
  }
  if (best == std::string::npos) return ways;
  ways.push_back(name);
  ways.back()[best] = '\n';
  std::string words = name;
  std::ranges::replace(words, ' ', '\n');
  if (words != ways.back()) ways.push_back(words);
  return ways;
}

/// How the pieces are coloured.
struct SheetColours {
  std::vector<Colour> cloth;  ///< per piece of the cut
  bool product = true;
  const StrainField* strain = nullptr;  ///< coloured by strain if set
};

class SheetPainter {
 public:
  SheetPainter(cairo_t* cairo, SheetFrame frame, const Pattern& pattern, SheetColours colours)
      : cairo_(cairo), frame_(frame), pattern_(pattern), colours_(std::move(colours)) {}

  void paint(std::size_t index) {
    const PatternPiece& piece = pattern_.pieces[index];
    placement_ = &pattern_.layout.placements[index];
    const std::uint32_t source = pattern_.pieceIndex[index];
    cloth_ = colours_.cloth[source];
    addOutlines(piece.cutLines);
    setColour(cairo_, {255, 255, 255});
    cairo_fill_preserve(cairo_);
    setStroke(cairo_, {kCutLine, Dash::Solid, 0.8}, frame_.scale);
    cairo_stroke(cairo_);
    if (colours_.strain != nullptr) {
      paintStrain(source);
    } else {
      addOutlines(piece.sewLines);
      setColour(cairo_, cloth_);
      cairo_fill(cairo_);
    }
    for (const InternalLine& line : piece.internalLines) paintInternal(line);
    for (const OutlineRun& run : piece.runs) paintRun(piece, run);
    if (colours_.strain != nullptr) return;  // nothing else on the map
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

  void paintStrain(std::size_t source) {
    const Piece& piece = pattern_.cut.pieces[source];
    const FlatPiece& flat = *pattern_.flats[source];
    // Without anti-aliasing no gaps show between faces; the sew line covers the steps at the rim.
    cairo_set_antialias(cairo_, CAIRO_ANTIALIAS_NONE);
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      const Triangle& t = piece.mesh->vertices(FaceId(f));
      cairo_new_path(cairo_);
      for (const VertexId v : t) lineTo(flat.position[v]);
      setColour(cairo_, colours_.strain->colour(source, FaceId(f)));
      cairo_fill(cairo_);
    }
    cairo_set_antialias(cairo_, CAIRO_ANTIALIAS_DEFAULT);
    cairo_new_path(cairo_);
    for (const auto& [a, b] : limitLine(*colours_.strain, pattern_, source)) {
      moveTo(a);
      lineTo(b);
    }
    setStroke(cairo_, {colourOf(0x16202E), Dash::Solid, 1.3}, frame_.scale);
    cairo_stroke(cairo_);
  }

  /// In products lines are a shade of their cloth, in plain pictures they tell their kinds.
  [[nodiscard]] LineStyle styled(LineStyle style, double width) const {
    style.width = width;
    if (colours_.product) style.colour = mix(cloth_, colourOf(0x14191F), 0.8);
    return style;
  }

  void paintInternal(const InternalLine& line) {
    if (line.points.empty()) return;
    cairo_new_path(cairo_);
    moveTo(line.points.front());
    for (const Vector2d& p : line.points) lineTo(p);
    if (line.closed) cairo_close_path(cairo_);
    // The sheet's lines are finer than the model's.
    const double width = colours_.product ? 0.9 : 0.75 * lineStyle(line.kind).width;
    setStroke(cairo_, styled(lineStyle(line.kind), width), frame_.scale * 0.8);
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
    setStroke(cairo_, styled(lineStyle(run.kind), run.kind == WireKind::Border ? 1.2 : 1.5),
              frame_.scale);
    cairo_stroke(cairo_);
  }

  void paintNotch(const Notch& notch) {
    cairo_new_path(cairo_);
    moveTo(notch.position);
    lineTo(notch.position + notch.depth * notch.direction);
    setStroke(cairo_, {kText, Dash::Solid, 1.0}, frame_.scale);
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
    const double barb = 3.5 * frame_.scale;
    for (const auto& [tip, sign] : {std::pair(low, 1.0), std::pair(high, -1.0)}) {
      for (const double side : {-0.6, 0.6}) {
        const Vector2d end = tip + barb * (sign * along + side * across);
        cairo_move_to(cairo_, tip.x(), tip.y());
        cairo_line_to(cairo_, end.x(), end.y());
      }
    }
    setStroke(cairo_, styled({kSecondText, Dash::Solid, 0}, 0.8), frame_.scale);
    cairo_stroke(cairo_);
  }

  void paintLabel(const PatternPiece& piece) {
    if (piece.name.empty()) return;
    LabelRoom room;
    for (const Outline& outline : piece.sewLines) {
      room.outlines.emplace_back();
      for (const OutlinePoint& point : outline) room.outlines.back().push_back(at(point.position));
    }
    for (const InternalLine& line : piece.internalLines) {
      room.lines.emplace_back();
      for (const Vector2d& p : line.points) room.lines.back().push_back(at(p));
    }
    room.lines.push_back({at(piece.grain[0]), at(piece.grain[1])});
    room.wish = at(piece.labelPosition);

    std::vector<std::string> texts = waysToBreak(piece.name);
    std::vector<LabelBlock> blocks;
    for (const std::string& text : texts) {
      constexpr double kMeasure = 100;
      const Vector2d size = TextBlock(cairo_, text, kMeasure, false).size() / kMeasure;
      blocks.push_back({size.x(), size.y(), blocks.empty() ? 1.0 : 0.9});
    }
    // Better a number than nothing where the name does not fit.
    texts.push_back(fmt::format("{}", piece.number));
    blocks.push_back({0.7, 1.2, 0.05});
    const std::optional<LabelPlace> place =
        fitLabel(room, blocks, kLabelSize * frame_.scale, kLeastLabelSize * frame_.scale);
    if (!place) return;
    TextBlock(cairo_, texts[place->block], place->size, false)
        .drawRound(cairo_, place->middle, place->angle, 1.3 * frame_.scale);
  }

  cairo_t* cairo_;
  SheetFrame frame_;
  const Pattern& pattern_;
  SheetColours colours_;
  const Placement* placement_ = nullptr;
  Colour cloth_;
};

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
  const TextBlock text(cairo, fmt::format("{:g} mm", mm), 11 * frame.scale, false);
  setColour(cairo, kSecondText);
  text.draw(cairo, left + (length - text.size().x()) / 2, y - 5 * frame.scale);
}

/// A bar of the strain colours with what they mean.
void drawStrainLegend(cairo_t* cairo, const PixelBox& box, const SheetFrame& frame,
                      const StrainField& field) {
  constexpr int kShades = 41;
  const double least = field.least();
  const std::array<std::string, 2> ends = field.ends();
  const TextBlock less(cairo, ends[0], 10 * frame.scale, false);
  const TextBlock more(cairo, ends[1], 10 * frame.scale, false);
  constexpr double kBetweenWords = 12;
  const double length =
      std::max(0.30 * box.width, less.size().x() + more.size().x() + kBetweenWords * frame.scale);
  const double left = box.x + kMargin * frame.scale;
  const double y = box.y + box.height - 30 * frame.scale;
  for (int i = 0; i < kShades; ++i) {
    cairo_rectangle(cairo, left + length * i / kShades, y, length / kShades + 0.5, 8 * frame.scale);
    setColour(cairo, field.colour(least + (1 - least) * i / (kShades - 1)));
    cairo_fill(cairo);
  }
  setColour(cairo, kSecondText);
  less.draw(cairo, left, y - 4 * frame.scale);
  more.draw(cairo, left + length - more.size().x(), y - 4 * frame.scale);
  const std::optional<double> limit = field.onlyLimit();
  if (!limit) return;
  const double at = left + length * (*limit / field.scale() - least) / (1 - least);
  cairo_new_path(cairo);
  cairo_move_to(cairo, at, y);
  cairo_line_to(cairo, at, y + 8 * frame.scale);
  setStroke(cairo, {colourOf(0x16202E), Dash::Solid, 1.3}, frame.scale);
  cairo_stroke(cairo);
  const TextBlock word(cairo, fmt::format("limit +{:g}", 100 * *limit), 10 * frame.scale, false);
  setColour(cairo, kSecondText);
  word.draw(cairo, at - word.size().x() / 2, y + 19 * frame.scale);
}

}  // namespace

double sheetHeight(int width, const Vector2d& size, double scale) {
  const double pixelsPerMm = std::max(1.0, width - 2 * kMargin * scale) / size.x();
  return pixelsPerMm * size.y() + (2 * kMargin + kScaleBarRoom) * scale;
}

void paintSheet(Picture& picture, const PixelBox& box, const Pattern& pattern,
                const RenderOptions& options, double scale) {
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

  SheetColours colours;
  colours.cloth = panelColours(pattern, options.style).flat;
  colours.product = options.style == RenderStyle::Product;
  std::optional<StrainField> strain;
  if (options.pieces == RenderPieces::Strain) {
    colours.strain = &strain.emplace(pattern, options.strain);
  }
  SheetPainter painter(cairo.get(), frame, pattern, colours);
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i) painter.paint(i);
  if (pattern.pieces.empty()) return;
  drawScaleBar(cairo.get(), box, frame);
  if (strain) drawStrainLegend(cairo.get(), box, frame, *strain);
}

void drawCaption(Picture& picture, const Caption& caption) {
  const Cairo cairo = drawOn(picture);
  const TextBlock text(cairo.get(), caption.text, caption.size, caption.bold);
  setColour(cairo.get(), caption.bold ? kText : kSecondText);
  text.draw(cairo.get(), caption.centred ? caption.x - text.size().x() / 2 : caption.x, caption.y);
}

}  // namespace toile
