// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/marker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace toile {
namespace {

using Eigen::Vector2d;

/// A piece of an order with what its fabric says.
struct Wanted {
  const Pattern* order = nullptr;
  std::size_t orderNumber = 0;
  std::size_t piece = 0;
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
  }
  for (Notch& notch : out.notches) {
    turn(notch.position);
    turn(notch.onSewLine);
    turn(notch.direction);
  }
  for (InternalLine& line : out.internalLines)
    for (Vector2d& p : line.points) turn(p);
  for (Vector2d& p : out.grain) turn(p);
  turn(out.labelPosition);
  return out;
}

NestPart partOf(const Wanted& wanted, const MarkerOptions& options) {
  const PatternPiece& piece = wanted.order->pieces[wanted.piece];
  NestPart part;
  part.name = piece.name;
  for (const OutlinePoint& p : piece.cutLines.front()) part.outline.push_back(p.position);
  const Vector2d grain = piece.grain[1] - piece.grain[0];
  part.grain = grain.norm() > 0 ? std::atan2(grain.y(), grain.x()) : 0.5 * std::numbers::pi;
  part.turns =
      options.turns.value_or(wanted.fabric != nullptr ? wanted.fabric->turns : Turns::TwoWay);
  part.count = piece.count * options.copies;
  part.mirrored = options.pairs ? part.count : 0;
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

Marker layOut(const std::vector<Wanted>& wanted, Nesting nesting, double width,
              const MarkerOptions& options, bool severalOrders) {
  constexpr double kBetweenSheetsMm = 100;
  Marker marker;
  const Fabric* fabric = wanted.front().fabric;
  if (fabric != nullptr) {
    marker.fabric = fabric->id;
    marker.name = fabric->name.empty() ? fabric->id : fabric->name;
  }
  marker.width = width;
  marker.sheet.document = wanted.front().order->document;
  const double perSheet = options.length.value_or(Length()).mm() + kBetweenSheetsMm;
  for (const NestPlace& place : nesting.places) {
    const Wanted& source = wanted[place.part];
    const PatternPiece& piece = source.order->pieces[source.piece];
    PatternPiece copy = place.mirrored ? turnedOver(piece) : piece;
    if (place.mirrored) copy.label.emplace_back("turned over");
    if (severalOrders) copy.label.push_back(orderText(source));
    copy.number = static_cast<int>(marker.sheet.pieces.size()) + 1;
    copy.of = static_cast<int>(nesting.places.size());
    Placement placement = place.placement;
    placement.offset.x() += place.sheet * perSheet;
    marker.sheet.layout.placements.push_back(placement);
    for (const OutlinePoint& p : copy.cutLines.front()) {
      const Vector2d at = placement.apply(p.position);
      marker.sheet.layout.max = marker.sheet.layout.max.cwiseMax(at);
    }
    marker.sheet.pieces.push_back(std::move(copy));
  }
  marker.nesting = std::move(nesting);
  return marker;
}

}  // namespace

Result<std::vector<Marker>> makeMarkers(std::span<const Pattern> orders,
                                        const MarkerOptions& options, Progress* progress) {
  std::vector<std::vector<Wanted>> byFabric;
  for (std::size_t o = 0; o < orders.size(); ++o) {
    const Pattern& order = orders[o];
    for (std::size_t i = 0; i < order.pieces.size(); ++i) {
      const Design& design = *order.document.design;
      const Fabric* fabric = fabricOf(design, recordOf(design, order.pieces[i].id));
      auto same =
          std::find_if(byFabric.begin(), byFabric.end(), [&](const std::vector<Wanted>& list) {
            const Fabric* other = list.front().fabric;
            return (other == nullptr) == (fabric == nullptr) &&
                   (fabric == nullptr || other->id == fabric->id);
          });
      if (same == byFabric.end()) same = byFabric.emplace(byFabric.end());
      same->push_back({&order, o, i, fabric});
    }
  }
  std::vector<Marker> markers;
  for (const std::vector<Wanted>& wanted : byFabric) {
    const Fabric* fabric = wanted.front().fabric;
    NestMaterial material = options.hide;
    material.width = options.width                            ? options.width->mm()
                     : fabric != nullptr && fabric->rollWidth ? fabric->rollWidth->mm()
                                                              : kUsualRollMm;
    if (options.length) material.length = options.length->mm();
    std::vector<NestPart> parts;
    for (const Wanted& each : wanted) parts.push_back(partOf(each, options));
    Result<Nesting> nesting = nest(parts, material, options.nest, progress);
    if (!nesting)
      return fabric == nullptr ? nesting.error()
                               : nesting.error().during("fabric \"" + fabric->id + "\"");
    markers.push_back(
        layOut(wanted, *std::move(nesting), material.width, options, orders.size() > 1));
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
