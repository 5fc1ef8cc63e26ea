// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pdf_canvas.h"

#include <cairo/cairo-pdf.h>
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/pdf_update.h"

namespace toile {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr int kFirstStandIn = 7;  // columns of the row of dots that stands in for a picture

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

template <auto destroy>
struct Deleter {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};

using Surface = std::unique_ptr<cairo_surface_t, Deleter<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Deleter<cairo_destroy>>;

/// A drawing apart, and where its box's zero point was when it was made.
struct Recorded {
  Surface surface;
  Eigen::Vector2d origin;
};

}  // namespace

struct PdfCanvas::State {
  std::string bytes;
  Surface surface;
  Context cairo;
  std::unique_ptr<PangoLayout, Deleter<g_object_unref>> layout;
  std::unique_ptr<PangoFontDescription, Deleter<pango_font_description_free>> font;
  std::vector<PngImage> images;
  std::vector<Recorded> recorded;
};

PdfCanvas::PdfCanvas() : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.surface.reset(cairo_pdf_surface_create_for_stream(append, &s.bytes, 100, 100));
  cairo_pdf_surface_restrict_to_version(s.surface.get(), CAIRO_PDF_VERSION_1_5);
  cairo_pdf_surface_set_metadata(s.surface.get(), CAIRO_PDF_METADATA_CREATOR, "Toile");
  s.cairo.reset(cairo_create(s.surface.get()));
  cairo_set_line_join(s.cairo.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(s.cairo.get(), CAIRO_LINE_CAP_BUTT);
  // Glyphs stay where the font puts them at any size: nothing is fitted to a screen's pixels.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(s.cairo.get(), options);
  s.layout.reset(pango_cairo_create_layout(s.cairo.get()));
  PangoContext* context = pango_layout_get_context(s.layout.get());
  pango_cairo_context_set_font_options(context, options);
  cairo_font_options_destroy(options);
  pango_cairo_context_set_resolution(context, 72);
  pango_context_set_round_glyph_positions(context, FALSE);
  pango_context_set_language(context, pango_language_from_string("en"));
  s.font.reset(pango_font_description_from_string("DejaVu Sans"));
}

PdfCanvas::~PdfCanvas() = default;

void PdfCanvas::setTitle(const std::string& utf8) {
  cairo_pdf_surface_set_metadata(state_->surface.get(), CAIRO_PDF_METADATA_TITLE, utf8.c_str());
}

void PdfCanvas::setDate(const std::string& iso) {
  cairo_pdf_surface_set_metadata(state_->surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 iso.c_str());
  hasDate_ = true;
}

void PdfCanvas::beginPage(double widthMm, double heightMm) {
  if (hasPage_) cairo_show_page(state_->cairo.get());
  hasPage_ = true;
  pageHeight_ = heightMm;
  shift_ = {0, 0};
  cairo_pdf_surface_set_size(state_->surface.get(), widthMm * kPointsPerMm,
                             heightMm * kPointsPerMm);
}

Eigen::Vector2d PdfCanvas::toPage(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d q = p + shift_;
  return kPointsPerMm * Eigen::Vector2d(q.x(), pageHeight_ - q.y());
}

void PdfCanvas::beginClip(const Box2& box) {
  cairo_t* cairo = state_->cairo.get();
  cairo_save(cairo);
  const Eigen::Vector2d corner = toPage({box.min.x(), box.max.y()});
  const Eigen::Vector2d size = kPointsPerMm * box.size();
  cairo_rectangle(cairo, corner.x(), corner.y(), size.x(), size.y());
  cairo_clip(cairo);
  isClipped_ = true;
  clip_ = box;
}

void PdfCanvas::endClip() {
  cairo_restore(state_->cairo.get());
  isClipped_ = false;
}

void PdfCanvas::line(const Points2& points, bool closed, const Pen& pen, double grey) {
  if (points.size() < 2) return;
  cairo_t* cairo = state_->cairo.get();
  cairo_set_source_rgb(cairo, grey, grey, grey);
  cairo_set_line_width(cairo, pen.width * kPointsPerMm);
  std::vector<double> dash = pen.dash;
  for (double& d : dash) d *= kPointsPerMm;
  const Box2 box = boxOf(points);
  const auto touchesClip = [&](const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    const double room = pen.width;
    return ((high - clip_.min).array() >= -room).all() &&
           ((clip_.max - low).array() >= -room).all();
  };
  const bool isWhole = !isClipped_ || ((box.min - clip_.min).minCoeff() >= 0 &&
                                       (clip_.max - box.max).minCoeff() >= 0);
  const auto setDash = [&](double from) {
    cairo_set_dash(cairo, dash.data(), static_cast<int>(dash.size()), from * kPointsPerMm);
  };
  const auto moveTo = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d q = toPage(p);
    cairo_move_to(cairo, q.x(), q.y());
  };
  const auto lineTo = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d q = toPage(p);
    cairo_line_to(cairo, q.x(), q.y());
  };
  if (isWhole) {
    setDash(0);
    moveTo(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) lineTo(points[i]);
    if (closed) cairo_close_path(cairo);
    cairo_stroke(cairo);
    return;
  }
  if (!touchesClip(box.min, box.max)) return;
  // Only the stretches that can be seen; each begins in its place of the dash pattern.
  double along = 0;
  bool isOpen = false;
  const std::size_t count = points.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& a = points[i];
    const Eigen::Vector2d& b = points[(i + 1) % points.size()];
    if (touchesClip(a.cwiseMin(b), a.cwiseMax(b))) {
      if (!isOpen) {
        setDash(along);
        moveTo(a);
      }
      isOpen = true;
      lineTo(b);
    } else if (isOpen) {
      cairo_stroke(cairo);
      isOpen = false;
    }
    along += (b - a).norm();
  }
  if (isOpen) cairo_stroke(cairo);
}

void PdfCanvas::drawText(const Eigen::Vector2d& at, double angle, double size, bool bold,
                         double grey, const std::string& utf8, double alignment) {
  cairo_t* cairo = state_->cairo.get();
  PangoLayout* layout = state_->layout.get();
  PangoFontDescription* font = state_->font.get();
  pango_font_description_set_absolute_size(font, size * kPointsPerMm * PANGO_SCALE);
  pango_font_description_set_weight(font, bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_layout_set_font_description(layout, font);
  pango_layout_set_text(layout, utf8.c_str(), static_cast<int>(utf8.size()));
  int width = 0;
  pango_layout_get_size(layout, &width, nullptr);
  const Eigen::Vector2d p = toPage(at);
  cairo_save(cairo);
  cairo_set_source_rgb(cairo, grey, grey, grey);
  cairo_translate(cairo, p.x(), p.y());
  cairo_rotate(cairo, -angle);
  cairo_move_to(cairo, -alignment * width / PANGO_SCALE,
                -static_cast<double>(pango_layout_get_baseline(layout)) / PANGO_SCALE);
  pango_cairo_show_layout(cairo, layout);
  cairo_restore(cairo);
}

void PdfCanvas::text(const SheetText& text, double grey) {
  if (text.text.empty()) return;
  if (isClipped_) {
    const double reach = estimatedWidth(text.text, text.size) + text.size;
    if ((text.position - clip_.max).maxCoeff() > reach ||
        (clip_.min - text.position).maxCoeff() > reach)
      return;
  }
  drawText(text.position, text.angle, text.size, text.bold, grey, text.text, 0.5);
}

double PdfCanvas::textFromLeft(const Eigen::Vector2d& baseline, double size,
                               const std::string& utf8, bool bold, double most) {
  const auto measured = [&](double em) {
    PangoFontDescription* font = state_->font.get();
    pango_font_description_set_absolute_size(font, em * kPointsPerMm * PANGO_SCALE);
    pango_font_description_set_weight(font, bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(state_->layout.get(), font);
    pango_layout_set_text(state_->layout.get(), utf8.c_str(), static_cast<int>(utf8.size()));
    int width = 0;
    pango_layout_get_size(state_->layout.get(), &width, nullptr);
    return static_cast<double>(width) / PANGO_SCALE / kPointsPerMm;
  };
  double width = measured(size);
  if (width > most) {
    size *= most / width;
    width = most;
  }
  drawText(baseline, 0, size, bold, 0, utf8, 0);
  return width;
}

void PdfCanvas::fill(const std::vector<Points2>& loops, const Ink& ink) {
  cairo_t* cairo = state_->cairo.get();
  for (const Points2& loop : loops) {
    if (loop.size() < 3) continue;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d p = toPage(loop[i]);
      if (i == 0) {
        cairo_move_to(cairo, p.x(), p.y());
      } else {
        cairo_line_to(cairo, p.x(), p.y());
      }
    }
    cairo_close_path(cairo);
  }
  cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, ink.opacity);
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(cairo);
}

std::size_t PdfCanvas::record(const Box2& box, const std::function<void()>& draw) {
  State& s = *state_;
  const Eigen::Vector2d corner = toPage({box.min.x(), box.max.y()});
  const Eigen::Vector2d size = kPointsPerMm * box.size();
  const cairo_rectangle_t extent{corner.x(), corner.y(), size.x(), size.y()};
  Surface surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extent));
  Context apart(cairo_create(surface.get()));
  cairo_set_line_join(apart.get(), cairo_get_line_join(s.cairo.get()));
  cairo_set_line_cap(apart.get(), cairo_get_line_cap(s.cairo.get()));
  std::swap(s.cairo, apart);
  draw();
  std::swap(s.cairo, apart);
  s.recorded.push_back({std::move(surface), toPage({0, 0})});
  return s.recorded.size() - 1;
}

void PdfCanvas::place(std::size_t recorded, const Eigen::Vector2d& shift) {
  cairo_t* cairo = state_->cairo.get();
  const Recorded& drawing = state_->recorded[recorded];
  const Eigen::Vector2d by = toPage(shift) - drawing.origin;
  cairo_save(cairo);
  cairo_set_source_surface(cairo, drawing.surface.get(), by.x(), by.y());
  cairo_paint(cairo);
  cairo_restore(cairo);
}

double PdfCanvas::image(std::string_view png, const Eigen::Vector2d& upperLeft, double width,
                        double mostHeight) {
  std::optional<PngImage> picture = parsePng(png);
  if (!picture) return 0;
  const double aspect = static_cast<double>(picture->rows) / picture->columns;
  const double height = std::min(width * aspect, mostHeight);
  // The library would pack the picture anew, which takes longer than all else of a document. It
  // draws one row of as many dots as no other picture has, which finish() replaces.
  State& s = *state_;
  const int columns = kFirstStandIn + static_cast<int>(s.images.size());
  s.images.push_back(*std::move(picture));
  const Surface standIn(cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, 1));
  cairo_t* cairo = s.cairo.get();
  const Eigen::Vector2d corner = toPage(upperLeft);
  cairo_save(cairo);
  cairo_translate(cairo, corner.x(), corner.y());
  cairo_scale(cairo, height / aspect * kPointsPerMm / columns, height * kPointsPerMm);
  cairo_set_source_surface(cairo, standIn.get(), 0, 0);
  cairo_paint(cairo);
  cairo_restore(cairo);
  return height;
}

Result<std::string> PdfCanvas::finish() {
  State& s = *state_;
  if (hasPage_) cairo_show_page(s.cairo.get());
  s.layout.reset();
  const cairo_status_t drawing = cairo_status(s.cairo.get());
  s.cairo.reset();
  cairo_surface_finish(s.surface.get());
  const cairo_status_t status =
      drawing != CAIRO_STATUS_SUCCESS ? drawing : cairo_surface_status(s.surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("the PDF could not be drawn: {}", cairo_status_to_string(status)),
                 {}};
  std::string bytes = hasDate_ ? std::move(s.bytes) : withoutCreationDate(std::move(s.bytes));
  for (std::size_t i = 0; i < s.images.size(); ++i)
    bytes = withImage(std::move(bytes), kFirstStandIn + static_cast<std::uint32_t>(i), s.images[i]);
  return bytes;
}

}  // namespace toile
