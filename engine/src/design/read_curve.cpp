// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/design_names.h"
#include "design/read_records.h"
#include "design/read_values.h"

namespace toile::detail {
namespace {

SubdivisionRule readRule(JsonObject& object) {
  const auto rule = object.find("rule");
  return rule ? rule->oneOf(kRuleNames) : SubdivisionRule::Auto;
}

std::vector<std::size_t> readCorners(JsonObject& object, std::size_t controls) {
  std::vector<std::size_t> corners;
  const auto list = object.find("corners");
  if (!list) return corners;
  for (const JsonPlace& item : list->items()) {
    const std::size_t index = item.index();
    if (index >= controls) item.fail("a corner must be one of the control points, from 0");
    if (!corners.empty() && index <= corners.back()) item.fail("corners must ascend");
    corners.push_back(index);
  }
  return corners;
}

ViewWay readViewWay(JsonObject& object, const JsonPlace& viewPlace) {
  ViewWay way;
  JsonObject view(viewPlace);
  way.view.eye = view.need("eye").vector<3>();
  way.view.target = view.need("target").vector<3>();
  way.view.up = readDirection(view.need("up"));
  way.view.height = readLengthFrom(view.need("height"), Length(), false).mm();
  way.view.perspective = view.need("perspective").boolean();
  way.unknownOfView = view.unknown();
  for (const JsonPlace& item : object.need("controls").items()) {
    way.controls.push_back(item.vector<2>());
  }
  way.rule = readRule(object);
  way.corners = readCorners(object, way.controls.size());
  way.unknown = object.unknown();
  return way;
}

AlongModelCurve readModelCurveWay(JsonObject& object, const JsonPlace& curve) {
  AlongModelCurve way;
  way.name = readName(curve);
  if (const auto from = object.find("from")) way.from = from->numberIn(0, 1);
  if (const auto to = object.find("to")) way.to = to->numberIn(0, 1);
  if (way.from == way.to) object.place().fail("\"from\" and \"to\" must differ");
  way.unknown = object.unknown();
  return way;
}

CurveWay readWay(const JsonPlace& at) {
  JsonObject object(at);
  if (const auto smooth = object.find("smooth")) {
    SmoothWay way{readPlaces(*smooth), readRule(object)};
    way.corners = readCorners(object, way.controls.size());
    way.unknown = object.unknown();
    return way;
  }
  if (const auto shortest = object.find("shortest")) {
    ShortestWay way{readPlaces(*shortest)};
    way.unknown = object.unknown();
    return way;
  }
  if (const auto view = object.find("view")) return readViewWay(object, *view);
  if (const auto curve = object.find("curve")) return readModelCurveWay(object, *curve);
  if (const auto section = object.find("section")) {
    AlongSection way{readPlane(*section)};
    way.unknown = object.unknown();
    return way;
  }
  if (const auto vertices = object.find("vertices")) {
    AlongVertices way;
    for (const JsonPlace& item : vertices->items()) way.vertices.emplace_back(item.index());
    way.unknown = object.unknown();
    return way;
  }
  at.fail(
      "a way has one of \"smooth\", \"shortest\", \"view\", \"curve\", \"section\", \"vertices\"");
  return SmoothWay{};
}

SeamSide readSide(const JsonPlace& at) {
  JsonObject object(at);
  SeamSide side;
  if (const auto allowance = object.find("allowance")) {
    side.allowance = readAllowance(*allowance);
  }
  if (const auto kind = object.find("kind")) side.kind = kind->oneOf(kSeamKindNames);
  if (const auto corner = object.find("corner")) side.corner = corner->oneOf(kCornerStyleNames);
  side.unknown = object.unknown();
  return side;
}

}  // namespace

StylingCurve readCurve(const JsonPlace& at) {
  JsonObject object(at);
  StylingCurve curve;
  curve.id = readId(object.need("id"));
  curve.name = object.text("name");
  curve.kind = object.need("kind").oneOf(kCurveKindNames);
  if (const auto closed = object.find("closed")) curve.closed = closed->boolean();
  if (const auto mirror = object.find("mirrorOf")) curve.mirrorOf = readId(*mirror);
  if (const auto way = object.find("way")) curve.way = readWay(*way);
  if (const auto points = object.find("points")) {
    for (const JsonPlace& item : points->items()) curve.dataPoints.push_back(readModelPoint(item));
  }
  if (!object.has("way") && curve.dataPoints.empty() && !curve.mirrorOf) {
    at.fail("a curve needs a \"way\", \"points\" or \"mirrorOf\"");
  }
  if (const auto range = object.find("elasticRange")) curve.elasticRange = readRatio(*range, 0, 1);
  if (const auto side = object.find("left")) curve.left = readSide(*side);
  if (const auto side = object.find("right")) curve.right = readSide(*side);
  curve.unknown = object.unknown();
  return curve;
}

}  // namespace toile::detail
