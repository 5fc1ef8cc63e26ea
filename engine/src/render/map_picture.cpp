// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/render/map_picture.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "finish/polygon.h"
#include "render/drawing_style.h"
#include "render/panel_colours.h"
#include "toile/model/guiding_map.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kMargin = 28;           // px, round each panel
constexpr double kCaptionRoom = 26;      // px, below it
constexpr double kBetweenSidesMm = 120;  // front and back of the map
constexpr Colour kSkin = colourOf(0xD8CFC4);
constexpr Colour kChartLine = colourOf(0x6B5F52);
constexpr Colour kCurveLine = colourOf(0x9A4B1E);
constexpr Colour kAxis = colourOf(0x2E6DA4);

struct CairoEnd {
  void operator()(cairo_t* c) const { cairo_destroy(c); }
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
};
using Surface = std::unique_ptr<cairo_surface_t, CairoEnd>;
using Cairo = std::unique_ptr<cairo_t, CairoEnd>;

cairo_status_t append(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// Both sides of a map beside each other.
struct MapSheet {
  std::array<Vector2d, 2> offset{Vector2d::Zero(), Vector2d::Zero()};
  Box2 box;
  [[nodiscard]] const Vector2d& of(MapSide side) const {
    return offset[side == MapSide::Back ? 1 : 0];
  }
};

MapSheet sheetOf(const GuidingMap& map) {
  std::array<Points2, 2> points;
  for (std::size_t i = 0; i < map.corners.size(); ++i) {
    const bool isBack = map.charts[map.chartOf[FaceId(i)]].side == MapSide::Back;
    for (const Vector2d& p : map.corners[FaceId(i)]) points[isBack ? 1 : 0].push_back(p);
  }
  MapSheet sheet;
  const Box2 front = boxOf(points[0]);
  const Box2 back = boxOf(points[1]);
  sheet.box = points[0].empty() ? back : front;
  if (points[0].empty() || points[1].empty()) return sheet;
  sheet.offset[1].x() = front.max.x() + kBetweenSidesMm - back.min.x();
  sheet.box.min = front.min.cwiseMin(back.min + sheet.offset[1]);
  sheet.box.max = front.max.cwiseMax(back.max + sheet.offset[1]);
  return sheet;
}

class MapPainter {
 public:
  explicit MapPainter(const MapPictureOptions& options) : options_(options) {
    surface_ = Surface(
        options.format == PictureFormat::Png
            ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, options.width, options.height)
            : cairo_svg_surface_create_for_stream(append, &bytes_, options.width, options.height));
    cairo_ = Cairo(cairo_create(surface_.get()));
    colour(kSheet);
    cairo_paint(cairo_.get());
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  }

  /// What follows is drawn in that part of the picture: millimetres, y up, centred.
  void frame(double left, double width, double pixelsPerMm, const Box2& box) {
    pixelsPerMm_ = pixelsPerMm;
    const Vector2d middle = 0.5 * (box.min + box.max);
    origin_ = {left + width / 2 - pixelsPerMm * middle.x(),
               (options_.height - kCaptionRoom) / 2 + pixelsPerMm * middle.y()};
  }

  void caption(double middle, const std::string& text) {
    cairo_select_font_face(cairo_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_.get(), 13);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_.get(), text.c_str(), &extents);
    colour(kSecondText);
    cairo_move_to(cairo_.get(), middle - extents.width / 2, options_.height - 12);
    cairo_show_text(cairo_.get(), text.c_str());
    cairo_new_path(cairo_.get());  // text leaves a point behind
  }

  void map(const ReferenceModel& model, const GuidingMap& map, const MapSheet& sheet, bool pale) {
    const Mesh& mesh = *model.mesh;
    const bool relief = options_.format == PictureFormat::Png;
    // Without anti-aliasing no gaps show between faces; the outline covers the steps at the rim.
    cairo_set_antialias(cairo_.get(), CAIRO_ANTIALIAS_NONE);
    for (std::size_t i = 0; relief && i < mesh.faceCount(); ++i) {
      const FaceId f(i);
      const MapSide side = map.charts[map.chartOf[f]].side;
      for (const Vector2d& p : map.corners[f]) lineTo(p + sheet.of(side));
      cairo_close_path(cairo_.get());
      colour(shade(mesh.normal(f), side, pale));
      cairo_fill(cairo_.get());
    }
    cairo_set_antialias(cairo_.get(), CAIRO_ANTIALIAS_DEFAULT);
    stroke(pale ? mix(kChartLine, kSheet, 0.55) : kChartLine, pale ? 0.8 : 1.4);
    for (std::size_t i = 0; i < mesh.edgeCount(); ++i) {
      const HalfedgeId h = mesh.halfedge(EdgeId(i));
      chartBorder(mesh, map, sheet, h);
      chartBorder(mesh, map, sheet, mesh.opposite(h));
    }
    cairo_stroke(cairo_.get());
    if (pale) return;
    stroke(kCurveLine, 0.9);
    for (const auto& [name, path] : model.curves) {
      for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
        const FaceId f = path.faceOfSegment[i];
        const Vector2d shift = sheet.of(map.charts[map.chartOf[f]].side);
        moveTo(shift + map.place(mesh, path.points[i], f));
        lineTo(shift + map.place(mesh, path.points[(i + 1) % path.points.size()], f));
      }
    }
    cairo_stroke(cairo_.get());
  }

  /// The medial axis of each side.
  void axes(const MapSheet& sheet) {
    stroke(kAxis, 0.8);
    const double dash = 6;
    cairo_set_dash(cairo_.get(), &dash, 1, 0);
    for (const Vector2d& offset : sheet.offset) {
      moveTo({offset.x(), sheet.box.min.y() - 15});
      lineTo({offset.x(), sheet.box.max.y() + 15});
      cairo_stroke(cairo_.get());
    }
    cairo_set_dash(cairo_.get(), nullptr, 0, 0);
  }

  void piece(const PatternPiece& piece, const Placement& placement, const Vector2d& shift,
             Colour cloth, double opacity) {
    const auto addLines = [&](const std::vector<Outline>& lines) {
      for (const Outline& line : lines) {
        for (const OutlinePoint& p : line) lineTo(shift + placement.apply(p.position));
        cairo_close_path(cairo_.get());
      }
    };
    cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_EVEN_ODD);
    addLines(piece.cutLines);
    colour(cloth, opacity);
    cairo_fill_preserve(cairo_.get());
    stroke(kText, 1.1);
    cairo_stroke(cairo_.get());
    addLines(piece.sewLines);
    stroke(kSecondText, 0.5);
    cairo_stroke(cairo_.get());
  }

  Result<std::string> finish() {
    cairo_.reset();
    cairo_status_t status = CAIRO_STATUS_SUCCESS;
    if (options_.format == PictureFormat::Png) {
      status = cairo_surface_write_to_png_stream(surface_.get(), append, &bytes_);
    } else {
      cairo_surface_finish(surface_.get());
      status = cairo_surface_status(surface_.get());
    }
    if (status != CAIRO_STATUS_SUCCESS)
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("the picture cannot be drawn: {}", cairo_status_to_string(status)),
                   {}};
    return std::move(bytes_);
  }

 private:
  void colour(Colour c, double opacity = 1) {
    cairo_set_source_rgba(cairo_.get(), c.r / 255.0, c.g / 255.0, c.b / 255.0, opacity);
  }
  void stroke(Colour c, double width) {
    colour(c);
    cairo_set_line_width(cairo_.get(), width);
  }
  [[nodiscard]] Vector2d at(const Vector2d& mm) const {
    return {origin_.x() + pixelsPerMm_ * mm.x(), origin_.y() - pixelsPerMm_ * mm.y()};
  }
  void moveTo(const Vector2d& p) { cairo_move_to(cairo_.get(), at(p).x(), at(p).y()); }
  void lineTo(const Vector2d& p) { cairo_line_to(cairo_.get(), at(p).x(), at(p).y()); }

  static Colour shade(const Eigen::Vector3d& normal, MapSide side, bool pale) {
    const double forwards = side == MapSide::Back ? 1 : -1;
    const Eigen::Vector3d light = Eigen::Vector3d(-0.45 * -forwards, forwards, 0.7).normalized();
    const double lit = std::clamp(0.5 + 0.5 * normal.dot(light), 0.0, 1.0);
    const Colour skin = mix(colourOf(0x7D7063), colourOf(0xF1EAE1), lit);
    return pale ? mix(skin, kSheet, 0.7) : mix(skin, kSkin, 0.1);
  }

  void chartBorder(const Mesh& mesh, const GuidingMap& map, const MapSheet& sheet, HalfedgeId h) {
    if (!h.isValid()) return;
    const FaceId f = mesh.face(h);
    const HalfedgeId twin = mesh.opposite(h);
    if (twin.isValid() && map.chartOf[mesh.face(twin)] == map.chartOf[f]) return;
    const Vector2d shift = sheet.of(map.charts[map.chartOf[f]].side);
    const auto k = static_cast<std::size_t>(mesh.side(h));
    moveTo(shift + map.corners[f][k]);
    lineTo(shift + map.corners[f][(k + 1) % 3]);
  }

  MapPictureOptions options_;
  std::string bytes_;
  Surface surface_;
  Cairo cairo_;
  double pixelsPerMm_ = 1;
  Vector2d origin_ = Vector2d::Zero();
};

Result<void> check(const MapPictureOptions& options) {
  for (const int size : {options.width, options.height})
    if (size < 64 || size > 20000)
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("a picture is 64 to 20000 px wide and high, not {} x {}",
                               options.width, options.height),
                   {}};
  return {};
}

double fittingScale(const MapPictureOptions& options, double width, const Vector2d& size) {
  return std::min((width - 2 * kMargin) / std::max(size.x(), 1e-6),
                  (options.height - 2 * kMargin - kCaptionRoom) / std::max(size.y(), 1e-6));
}

}  // namespace

Result<std::string> drawGuidingMap(const ReferenceModel& model, const MapPictureOptions& options) {
  if (const Result<void> fine = check(options); !fine) return fine.error();
  const std::shared_ptr<const GuidingMap> map = guidingMap(model);
  const MapSheet sheet = sheetOf(*map);
  MapPainter painter(options);
  painter.frame(0, options.width, fittingScale(options, options.width, sheet.box.size()),
                sheet.box);
  painter.map(model, *map, sheet, false);
  painter.axes(sheet);
  painter.caption(options.width / 2.0, "guiding map of " + model.name);
  return painter.finish();
}

Result<std::string> drawMapLayout(const Pattern& pattern, const MapPictureOptions& options) {
  if (const Result<void> fine = check(options); !fine) return fine.error();
  const ReferenceModel& model = *pattern.document.model;
  const std::shared_ptr<const GuidingMap> map = guidingMap(model);
  const MapSheet sheet = sheetOf(*map);
  const Layout& layout = pattern.layout;
  const std::vector<Colour> cloth = panelColours(pattern, RenderStyle::Plain).flat;
  Points2 onMap{sheet.box.min, sheet.box.max};
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i)
    for (const OutlinePoint& p : pattern.pieces[i].cutLines.front())
      onMap.push_back(sheet.of(layout.side[i]) + layout.onMap[i].apply(p.position));
  const Box2 mapBox = boxOf(onMap);
  const double width = options.width / 3.0;
  const double scale =
      fittingScale(options, width, mapBox.size().cwiseMax(layout.max - layout.min));
  MapPainter painter(options);
  painter.frame(0, width, scale, mapBox);
  painter.map(model, *map, sheet, false);
  painter.axes(sheet);
  painter.caption(width / 2, "guiding map");
  painter.frame(width, width, scale, mapBox);
  painter.map(model, *map, sheet, true);
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i)
    painter.piece(pattern.pieces[i], layout.onMap[i], sheet.of(layout.side[i]),
                  cloth[pattern.pieceIndex[i]], 0.6);
  painter.axes(sheet);
  painter.caption(1.5 * width, "pieces on their places");
  painter.frame(2 * width, width, scale, {layout.min, layout.max});
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i)
    painter.piece(pattern.pieces[i], layout.placements[i], Vector2d::Zero(),
                  cloth[pattern.pieceIndex[i]], 1);
  painter.caption(2.5 * width, "moved apart");
  return painter.finish();
}

}  // namespace toile
