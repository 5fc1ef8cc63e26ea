// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/marker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "finish/polygon.h"
#include "layout/mirror_images.h"
#include "toile/core/parallel.h"
#include "toile/io/sheet_drawing.h"

namespace toile {
namespace {

using Eigen::Vector2d;

/// A piece of an order as it is cut, with what its fabric says.
struct Wanted {
  const Pattern* order = nullptr;
  std::size_t orderNumber = 0;
  PatternPiece piece;
  int count = 1;            ///< outlines to cut, as the piece is drawn
  int mirrored = 0;         ///< and turned over
  bool givesSpare = false;  ///< folded cloth gives its mirror image too, which nobody needs
  const Fabric* fabric = nullptr;
};

/// The piece turned over: (x, y) -> (-x, y).
PatternPiece turnedOver(const PatternPiece& piece) {
  PatternPiece out = piece;
  const auto turn = [](Vector2d& p) { p.x() = -p.x(); };
  for (std::vector<Outline>* lines : {&out.sewLines, &out.cutLines}) {
    for (Outline& line : *lines) {
      for (OutlinePoint& p : line) turn(p.position);
      std::reverse(line.begin(), line.end());
    }
  }
  for (OutlineRun& run : out.runs) {
    if (run.loop >= out.sewLines.size() || out.sewLines[run.loop].empty()) continue;
    // Point i has become point n - 1 - i: the run begins where it ended.
    const std::size_t n = out.sewLines[run.loop].size();
    run.first = (2 * n - 1 - (run.first + run.edgeCount) % n) % n;
    for (std::size_t& end : run.arcEnds) end = run.edgeCount - end;
    std::reverse(run.arcEnds.begin(), run.arcEnds.end());
  }
  std::reverse(out.runs.begin(), out.runs.end());
  for (Notch& notch : out.notches) {
    turn(notch.position);
    turn(notch.onSewLine);
    turn(notch.direction);
  }
  for (Vector2d& hole : out.drillHoles) turn(hole);
  for (InternalLine& line : out.internalLines)
    for (Vector2d& p : line.points) turn(p);
  for (Vector2d& p : out.grain) turn(p);
  if (out.fold) {
    for (Vector2d& p : *out.fold) turn(p);
    std::swap((*out.fold)[0], (*out.fold)[1]);
  }
  turn(out.labelPosition);
  return out;
}

/// Of a half piece: whether its fold runs along the grain, so that it can lie on the cloth's.
bool foldsAlongGrain(const PatternPiece& piece) {
  const Vector2d fold = ((*piece.fold)[1] - (*piece.fold)[0]).normalized();
  const Vector2d grain = (piece.grain[1] - piece.grain[0]).normalized();
  return std::abs(fold.x() * grain.y() - fold.y() * grain.x()) < 1e-6;
}

/// Whether one outline of folded cloth gives both pieces. Mirror images lie mirrored on the guiding
/// map, whose axis is x = 0.
bool areMirrorImages(const Pattern& order, std::size_t a, std::size_t b) {
  if (order.layout.side[a] != order.layout.side[b]) return false;
  const auto onMap = [&](std::size_t i, double across) {
    Points2 points = positions(order.pieces[i].cutLines.front());
    for (Vector2d& p : points) {
      p = order.layout.onMap[i].apply(p);
      p.x() *= across;
    }
    return points;
  };
  const Points2 first = onMap(a, -1);
  const Points2 second = onMap(b, 1);
  if ((boxOf(first).min - boxOf(second).min).cwiseAbs().maxCoeff() > kSameLineMm) return false;
  const auto isOn = [](const Points2& points, const Points2& line) {
    const EdgeGrid grid({line});
    return std::all_of(points.begin(), points.end(),
                       [&](const Vector2d& p) { return grid.nearest(p).distance <= kSameLineMm; });
  };
  return isOn(first, second) && isOn(second, first);
}

/// All pieces of an order on cloth that lies flat.
std::vector<Wanted> piecesOf(const Pattern& order, const MarkerOptions& options) {
  std::vector<Wanted> pieces;
  for (const PatternPiece& piece : order.pieces) {
    const int count = piece.count * options.copies;
    pieces.push_back({&order, 0, piece, count, options.pairs ? count : 0});
  }
  return pieces;
}

/// On folded cloth: halves, one piece of each pair, and the others.
std::vector<Wanted> piecesOnFold(const Pattern& order, const MarkerOptions& options) {
  std::vector<Wanted> pieces;
  std::vector<char> isDone(order.pieces.size(), 0);
  for (std::size_t i = 0; i < order.pieces.size(); ++i) {
    if (isDone[i] != 0) continue;
    const std::uint32_t index = order.pieceIndex[i];
    const int count = order.pieces[i].count * options.copies;
    PatternPiece half = order.pieces[i];
    if (foldInHalf(half, order.cut.pieces[index], *order.flats[index]) && foldsAlongGrain(half)) {
      // The piece lies on the left of its fold: above it once the grain runs to the right, or
      // below; then it is turned over, which a symmetric piece does not notice.
      const Vector2d along = (*half.fold)[1] - (*half.fold)[0];
      const bool isAbove = along.dot(half.grain[1] - half.grain[0]) > 0;
      const int halves = options.pairs ? 2 * count : count;
      pieces.push_back({&order, 0, isAbove ? half : turnedOver(half), halves});
      continue;
    }
    pieces.push_back({&order, 0, order.pieces[i], count});
    PatternPiece& piece = pieces.back().piece;
    const auto twin =
        std::find_if(order.pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1, order.pieces.end(),
                     [&](const PatternPiece& other) {
                       const auto j = static_cast<std::size_t>(&other - order.pieces.data());
                       return isDone[j] == 0 && other.fabric == piece.fabric &&
                              other.count == piece.count && areMirrorImages(order, i, j);
                     });
    if (twin != order.pieces.end()) {
      isDone[static_cast<std::size_t>(twin - order.pieces.begin())] = 1;
      piece.label.push_back(fmt::format("and {} {}", twin->number, twin->name));
      if (options.pairs) pieces.back().count *= 2;
    } else {
      pieces.back().givesSpare = !options.pairs;
    }
  }
  return pieces;
}

NestPart partOf(const Wanted& wanted, const MarkerOptions& options) {
  const PatternPiece& piece = wanted.piece;
  NestPart part;
  part.name = piece.name;
  for (const OutlinePoint& p : piece.cutLines.front()) part.outline.push_back(p.position);
  const Vector2d grain = piece.grain[1] - piece.grain[0];
  part.grain = grain.norm() > 0 ? std::atan2(grain.y(), grain.x()) : 0.5 * std::numbers::pi;
  part.turns =
      options.turns.value_or(wanted.fabric != nullptr ? wanted.fabric->turns : Turns::TwoWay);
  part.count = wanted.count;
  part.mirrored = wanted.mirrored;
  part.onFold = piece.fold.has_value();
  return part;
}

/// Which order a piece belongs to, for its label.
std::string orderText(const Wanted& wanted) {
  const Order& order = wanted.order->document.design->order;
  std::string text = fmt::format("order {}", wanted.orderNumber + 1);
  if (!order.customer.empty()) text += ", " + order.customer;
  if (!order.size.empty()) text += ", " + order.size;
  return text;
}

/// The edges of the material, its faults, and what the marker is.
void drawMaterial(Marker& marker, const NestMaterial& material, double perSheet) {
  const Pen edge{0.35, {}};
  const Pen fold{0.35, {12, 3, 3, 3}};
  const Pen fault{0.25, {2, 2}};
  const auto add = [&](std::vector<Vector2d> points, bool closed, const Pen& pen,
                       const char* kind) {
    SheetLine line;
    line.role = SheetRole::Material;
    line.points = std::move(points);
    line.closed = closed;
    line.pen = pen;
    line.kind = kind;
    marker.sheet.around.lines.push_back(std::move(line));
  };
  const Nesting& nesting = marker.nesting;
  const double height = material.width;
  double right = 0;
  if (!material.hide.empty()) {
    add(material.hide, true, edge, "hide");
    for (const Vector2d& p : material.hide) right = std::max(right, p.x());
  }
  for (std::uint32_t sheet = 0; material.hide.empty() && sheet < nesting.sheets; ++sheet) {
    const double left = sheet * perSheet;
    right = left + material.length.value_or(nesting.length);
    add({{left, 0}, {right, 0}}, false, marker.folded ? fold : edge,
        marker.folded ? "fold" : "edge");
    add({{right, 0}, {right, height}, {left, height}, {left, 0}}, false, edge, "edge");
  }
  for (std::uint32_t sheet = 0; sheet < nesting.sheets; ++sheet)
    for (const std::vector<Vector2d>& polygon : material.faults) {
      std::vector<Vector2d> points = polygon;
      for (Vector2d& p : points) p.x() += sheet * perSheet;
      add(std::move(points), true, fault, "fault");
    }
  std::string figures = marker.name.empty() ? std::string() : marker.name + ": ";
  if (nesting.sheets > 1) figures += fmt::format("{} sheets, ", nesting.sheets);
  figures += fmt::format("{:.0f} mm of {:.0f} mm{}, {} pieces, {:.1f} % used", nesting.length,
                         marker.width, marker.folded ? " on the fold" : "", nesting.places.size(),
                         100 * nesting.utilisation);
  // Beyond the end, read with the roll's end at the left.
  double at = right + 14;
  for (const std::string& text : {marker.sheet.heading, figures}) {
    const double size = std::min(10.0, 0.9 * height / std::max(1.0, estimatedWidth(text, 1)));
    marker.sheet.around.texts.push_back(
        {SheetRole::Material, {at, 0.5 * height}, 0.5 * std::numbers::pi, size, false, text});
    at += 14;
  }
}

Marker layOut(const std::vector<Wanted>& wanted, Nesting nesting, const NestMaterial& material,
              const MarkerOptions& options, bool severalOrders) {
  constexpr double kBetweenSheetsMm = 100;
  Marker marker;
  const Fabric* fabric = wanted.front().fabric;
  if (fabric != nullptr) {
    marker.fabric = fabric->id;
    marker.name = fabric->name.empty() ? fabric->id : fabric->name;
  }
  marker.folded = options.fold;
  marker.width = (options.fold ? 2 : 1) * material.width;
  marker.sheet = makeEmptySheet(*wanted.front().order->document.design);
  if (severalOrders) marker.sheet.heading = marker.sheet.name;
  marker.sheet.isMarker = true;
  const double perSheet = material.length.value_or(0) + kBetweenSheetsMm;
  marker.sheet.pieces.resize(nesting.places.size());
  parallelFor(nesting.places.size(), [&](std::size_t i) {
    const NestPlace& place = nesting.places[i];
    const Wanted& source = wanted[place.part];
    PatternPiece copy = place.mirrored ? turnedOver(source.piece) : source.piece;
    if (place.mirrored) copy.label.emplace_back("turned over");
    if (severalOrders) copy.label.push_back(orderText(source));
    Placement placement = place.placement;
    placement.offset.x() += place.sheet * perSheet;
    marker.sheet.pieces[i] = drawPiece(*source.order, copy, placement);
  });
  for (const Wanted& each : wanted)
    if (each.givesSpare)
      marker.findings.push_back(
          {"cut-double",
           fmt::format("piece \"{}\" has no mirror image: folded cloth gives it twice, the second "
                       "one turned over; cut it from one layer",
                       each.piece.name),
           {Element::piece(each.piece.id)}});
  marker.nesting = std::move(nesting);
  drawMaterial(marker, material, perSheet);
  fitBox(marker.sheet);
  // Room for the texts beyond the end.
  constexpr double kTextsMm = 36;
  marker.sheet.max.x() += kTextsMm;
  return marker;
}

}  // namespace

Result<std::vector<Marker>> makeMarkers(std::span<const Pattern> orders,
                                        const MarkerOptions& options, Progress* progress) {
  if (options.fold && !options.hide.hide.empty())
    return Error{ErrorCode::InvalidArgument, "a hide cannot be laid on the fold", {}};
  std::vector<std::vector<Wanted>> byFabric;
  for (std::size_t o = 0; o < orders.size(); ++o) {
    const Pattern& order = orders[o];
    for (Wanted& piece : options.fold ? piecesOnFold(order, options) : piecesOf(order, options)) {
      const Design& design = *order.document.design;
      const Fabric* fabric = fabricOf(design, recordOf(design, piece.piece.id));
      piece.orderNumber = o;
      piece.fabric = fabric;
      auto same =
          std::find_if(byFabric.begin(), byFabric.end(), [&](const std::vector<Wanted>& list) {
            const Fabric* other = list.front().fabric;
            return (other == nullptr) == (fabric == nullptr) &&
                   (fabric == nullptr || other->id == fabric->id);
          });
      if (same == byFabric.end()) same = byFabric.emplace(byFabric.end());
      same->push_back(std::move(piece));
    }
  }
  std::vector<Marker> markers;
  for (const std::vector<Wanted>& wanted : byFabric) {
    const Fabric* fabric = wanted.front().fabric;
    NestMaterial material = options.hide;
    material.width = options.width                            ? options.width->mm()
                     : fabric != nullptr && fabric->rollWidth ? fabric->rollWidth->mm()
                                                              : kUsualRollMm;
    if (options.fold) material.width *= 0.5;
    if (options.length) material.length = options.length->mm();
    if (!material.hide.empty()) {
      material.width = 0;
      for (const Vector2d& p : material.hide) material.width = std::max(material.width, p.y());
    }
    std::vector<NestPart> parts;
    for (const Wanted& each : wanted) parts.push_back(partOf(each, options));
    Result<Nesting> nesting = nest(parts, material, options.nest, progress);
    if (!nesting)
      return fabric == nullptr ? nesting.error()
                               : nesting.error().during("fabric \"" + fabric->id + "\"");
    markers.push_back(layOut(wanted, *std::move(nesting), material, options, orders.size() > 1));
  }
  return markers;
}

std::string writeMarkersJson(std::span<const Marker> markers) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Marker& marker : markers) {
    nlohmann::ordered_json places = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < marker.nesting.places.size(); ++i) {
      const NestPlace& place = marker.nesting.places[i];
      places.push_back({{"piece", marker.sheet.pieces[i].id},
                        {"name", marker.sheet.pieces[i].name},
                        {"turnedOver", place.mirrored},
                        {"sheet", place.sheet},
                        {"angle", place.placement.angle * 180 / std::numbers::pi},
                        {"offset", {place.placement.offset.x(), place.placement.offset.y()}}});
    }
    list.push_back({{"fabric", marker.fabric},
                    {"name", marker.name},
                    {"width", marker.width},
                    {"folded", marker.folded},
                    {"length", marker.nesting.length},
                    {"sheets", marker.nesting.sheets},
                    {"area", marker.nesting.area},
                    {"utilisation", marker.nesting.utilisation},
                    {"boundLength", marker.nesting.bound},
                    {"pieces", std::move(places)}});
  }
  const nlohmann::ordered_json whole = {
      {"toile-marker", 1}, {"units", "mm"}, {"markers", std::move(list)}};
  return whole.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace toile
