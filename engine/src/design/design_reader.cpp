// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "design/design_names.h"
#include "design/json_object.h"
#include "design/single_places.h"
#include "toile/core/file.h"
#include "toile/design/design_file.h"

namespace toile {
namespace {

constexpr std::uint32_t kMaxCount = 10000;
constexpr double kWeightSumTolerance = 1e-9;

// ---- single values

std::string readId(const JsonPlace& at) {
  const std::string id = at.string();
  const auto isAllowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (id.empty() || !std::all_of(id.begin(), id.end(), isAllowed)) {
    at.fail("an id is made of letters a-z A-Z, digits, \"_\" and \"-\"");
  }
  return id;
}

std::string readName(const JsonPlace& at) {
  std::string name = at.string();
  if (name.empty()) at.fail("must not be empty");
  return name;
}

Length readLength(const JsonPlace& at) {
  return at.parsed(parseLength);
}

Length readLengthFrom(const JsonPlace& at, Length least, bool orEqual = true) {
  const Length length = readLength(at);
  if (length < least || (!orEqual && length == least)) {
    at.fail(std::string("must ") + (orEqual ? "not be below " : "be above ") + toString(least));
  }
  return length;
}

Ratio readRatio(const JsonPlace& at, double low, double high) {
  const Ratio ratio = at.parsed(parseRatio, Ratio::of(low));
  if (ratio.value() < low || ratio.value() > high) {
    at.fail("must be between " + toString(Ratio::of(low)) + " and " + toString(Ratio::of(high)));
  }
  return ratio;
}

Eigen::Vector3d readDirection(const JsonPlace& at) {
  const Eigen::Vector3d direction = at.vector<3>();
  if (direction.isZero(0)) at.fail("a direction must not be zero");
  return direction;
}

ContentHash readHash(const JsonPlace& at) {
  const std::string text = at.string();
  ContentHash hash;
  const auto digit = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (text.size() != 32 ||
      !std::all_of(text.begin(), text.end(), [&](char c) { return digit(c) >= 0; })) {
    at.fail("must be 32 hexadecimal digits");
    return hash;
  }
  for (std::size_t i = 0; i < 32; ++i) {
    std::uint64_t& word = hash.words[i / 16];
    word = (word << 4) | static_cast<std::uint64_t>(digit(text[i]));
  }
  return hash;
}

// ---- places

ModelPoint readModelPoint(const JsonPlace& at) {
  JsonObject object(at);
  ModelPoint point;
  if (const auto vertex = object.find("vertex")) {
    point.at = VertexId(vertex->index());
  } else if (const auto edge = object.find("edge")) {
    ModelPoint::OnEdge onEdge;
    const std::vector<JsonPlace> ends = edge->items(2);
    if (ends.size() == 2) {
      onEdge.tail = VertexId(ends[0].index());
      onEdge.head = VertexId(ends[1].index());
      if (onEdge.tail >= onEdge.head) edge->fail("the smaller vertex number comes first");
    }
    const JsonPlace t = object.need("t");
    onEdge.t = t.number();
    if (!(onEdge.t > 0 && onEdge.t < 1)) t.fail("must be above 0 and below 1");
    point.at = onEdge;
  } else if (const auto face = object.find("face")) {
    const JsonPlace weights = object.need("weights");
    const SurfacePoint::InFace inFace{FaceId(face->index()), weights.vector<3>()};
    if (!(inFace.barycentric.minCoeff() > 0) ||
        !(std::abs(inFace.barycentric.sum() - 1) <= kWeightSumTolerance)) {
      weights.fail("must each be above 0 and add up to 1");
    }
    point.at = inFace;
  } else {
    at.fail("a point of the model has \"vertex\", \"edge\" or \"face\"");
  }
  object.refuseUnknown();
  return point;
}

SectionPlane readPlane(const JsonPlace& at) {
  JsonObject object(at);
  SectionPlane plane;
  plane.normal = readDirection(object.need("normal"));
  if (const auto through = object.find("through")) {
    if (object.has("offset") || object.has("point")) {
      at.fail("a section has one of \"through\", \"point\", \"offset\"");
    }
    plane.through = AtLandmark{readName(*through)};
  } else if (const auto point = object.find("point")) {
    if (object.has("offset")) at.fail("a section has one of \"through\", \"point\", \"offset\"");
    plane.through = readModelPoint(*point);
  } else {
    plane.through = readLength(object.need("offset"));
  }
  plane.unknown = object.unknown();
  return plane;
}

SinglePlace readSinglePlace(const JsonPlace& at) {
  JsonObject object(at);
  if (const auto landmark = object.find("landmark")) {
    const std::string name = readName(*landmark);
    return AtLandmark{name, object.unknown()};
  }
  if (const auto curve = object.find("curve")) {
    const std::string name = readName(*curve);
    const double fraction = object.need("at").numberIn(0, 1);
    return OnModelCurve{name, fraction, object.unknown()};
  }
  if (const auto line = object.find("line")) {
    const std::string id = readId(*line);
    const double fraction = object.need("at").numberIn(0, 1);
    return OnStylingCurve{id, fraction, object.unknown()};
  }
  if (const auto section = object.find("section")) {
    const SectionPlane plane = readPlane(*section);
    const Eigen::Vector3d direction = readDirection(object.need("direction"));
    return OnSection{plane, direction, object.unknown()};
  }
  if (const auto near = object.find("near")) {
    const Eigen::Vector3d position = near->vector<3>();
    return NearPosition{position, object.unknown()};
  }
  if (object.has("between")) at.fail("the ends of \"between\" are no \"between\" themselves");
  if (!object.has("vertex") && !object.has("edge") && !object.has("face")) {
    at.fail(
        "a place has one of \"landmark\", \"curve\", \"line\", \"between\", \"section\", \"near\", "
        "\"vertex\", \"edge\", \"face\"");
  }
  return readModelPoint(at);
}

Place readPlace(const JsonPlace& at) {
  JsonObject object(at);
  const auto between = object.find("between");
  if (!between) {
    return std::visit([](const auto& place) { return Place(place); }, readSinglePlace(at));
  }
  BetweenPlaces place;
  const std::vector<JsonPlace> ends = between->items(2);
  for (std::size_t i = 0; i < ends.size(); ++i) place.ends[i] = readSinglePlace(ends[i]);
  place.fraction = object.need("at").numberIn(0, 1);
  place.unknown = object.unknown();
  return place;
}

std::vector<Place> readPlaces(const JsonPlace& at) {
  std::vector<Place> out;
  for (const JsonPlace& item : at.items()) out.push_back(readPlace(item));
  return out;
}

// ---- ways

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

// ---- records

SeamSide readSide(const JsonPlace& at) {
  JsonObject object(at);
  SeamSide side;
  if (const auto allowance = object.find("allowance")) {
    side.allowance = readLengthFrom(*allowance, Length());
  }
  if (const auto kind = object.find("kind")) side.kind = kind->oneOf(kSeamKindNames);
  if (const auto corner = object.find("corner")) side.corner = corner->oneOf(kCornerStyleNames);
  side.unknown = object.unknown();
  return side;
}

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

Ease readEase(const JsonPlace& at) {
  constexpr double kLeast = -0.9, kMost = 10;
  Ease ease;
  if (at.is(JsonValue::Kind::String)) {
    ease.girth = ease.length = readRatio(at, kLeast, kMost);
    return ease;
  }
  JsonObject object(at);
  if (const auto girth = object.find("girth")) ease.girth = readRatio(*girth, kLeast, kMost);
  if (const auto length = object.find("length")) ease.length = readRatio(*length, kLeast, kMost);
  if (const auto along = object.find("along")) ease.along = readName(*along);
  ease.unknown = object.unknown();
  return ease;
}

DevelopSetting readDevelop(const JsonPlace& at) {
  JsonObject object(at);
  DevelopSetting develop;
  if (const auto amount = object.find("amount")) develop.amount = readRatio(*amount, 0, 1);
  if (const auto error = object.find("maxAreaError")) {
    develop.maxAreaError = readRatio(*error, 1e-4, 1);
  }
  if (develop.amount.has_value() == develop.maxAreaError.has_value()) {
    at.fail("needs either \"amount\" or \"maxAreaError\"");
  }
  if (const auto gap = object.find("gap")) develop.gap = readLengthFrom(*gap, Length());
  develop.unknown = object.unknown();
  return develop;
}

Grain readGrain(const JsonPlace& at) {
  JsonObject object(at);
  Grain grain;
  if (const auto along = object.find("along")) grain.along = along->oneOf(kGrainAxisNames);
  if (const auto turn = object.find("turn")) grain.turn = turn->parsed(parseAngle, Angle());
  grain.unknown = object.unknown();
  return grain;
}

Twin readTwin(const JsonPlace& at) {
  JsonObject object(at);
  Twin twin;
  twin.of = readId(object.need("of"));
  if (const auto mode = object.find("mode")) twin.mode = mode->oneOf(kTwinModeNames);
  twin.unknown = object.unknown();
  return twin;
}

ClothWeights readWeights(const JsonPlace& at) {
  constexpr double kLeast = 1e-3, kMost = 1e3;
  JsonObject object(at);
  ClothWeights weights;
  const auto read = [&](std::string_view key, double& weight) {
    const auto found = object.find(key);
    if (found) weight = found->numberIn(kLeast, kMost);
  };
  read("along", weights.along);
  read("across", weights.across);
  read("shear", weights.shear);
  weights.unknown = object.unknown();
  return weights;
}

PieceRecord readPiece(const JsonPlace& at) {
  JsonObject object(at);
  PieceRecord piece;
  piece.id = readId(object.need("id"));
  piece.name = object.text("name");
  piece.anchor = readPlace(object.need("anchor"));
  if (const auto include = object.find("include")) piece.include = include->boolean();
  if (const auto count = object.find("count")) {
    piece.count = static_cast<int>(count->index(kMaxCount));
    if (piece.count == 0) count->fail("must be 1 or more");
  }
  if (const auto fabric = object.find("fabric")) piece.fabric = readId(*fabric);
  if (const auto ease = object.find("ease")) piece.ease = readEase(*ease);
  if (const auto develop = object.find("develop")) piece.develop = readDevelop(*develop);
  if (const auto grain = object.find("grain")) piece.grain = readGrain(*grain);
  if (const auto twin = object.find("twin")) piece.twin = readTwin(*twin);
  if (const auto boundary = object.find("boundary")) {
    for (const JsonPlace& item : boundary->items()) piece.boundary.push_back(readId(item));
  }
  piece.unknown = object.unknown();
  return piece;
}

Fabric readFabric(const JsonPlace& at) {
  constexpr double kMaxStretch = 10;
  JsonObject object(at);
  Fabric fabric;
  fabric.id = readId(object.need("id"));
  fabric.name = object.text("name");
  if (const auto colour = object.find("colour")) {
    fabric.colour = colour->string();
    const auto isHex = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    };
    if (fabric.colour.size() != 7 || fabric.colour[0] != '#' ||
        !std::all_of(fabric.colour.begin() + 1, fabric.colour.end(), isHex)) {
      colour->fail("a colour is written like \"#1a2b3c\"");
    }
  }
  const auto limit = [&](std::string_view key) -> std::optional<Ratio> {
    const auto found = object.find(key);
    if (!found) return std::nullopt;
    return readRatio(*found, 0, kMaxStretch);
  };
  fabric.stretchAlong = limit("stretchAlong");
  fabric.stretchAcross = limit("stretchAcross");
  fabric.shear = limit("shear");
  if (const auto weights = object.find("weights")) fabric.weights = readWeights(*weights);
  if (const auto thickness = object.find("thickness")) {
    fabric.thickness = readLengthFrom(*thickness, Length());
  }
  if (const auto offset = object.find("thicknessOffset")) {
    fabric.thicknessOffset = readRatio(*offset, 0, 1);
  }
  if (const auto width = object.find("rollWidth")) {
    fabric.rollWidth = readLengthFrom(*width, Length(), false);
  }
  if (const auto allowance = object.find("allowance")) {
    fabric.allowance = readLengthFrom(*allowance, Length());
  }
  if (const auto turns = object.find("turns")) fabric.turns = turns->oneOf(kTurnsNames);
  if (const auto ease = object.find("ease")) fabric.ease = readEase(*ease);
  fabric.unknown = object.unknown();
  return fabric;
}

Order readOrder(const JsonPlace& at) {
  JsonObject object(at);
  Order order;
  order.style = object.text("style");
  order.size = object.text("size");
  order.customer = object.text("customer");
  if (const auto date = object.find("date")) {
    order.date = date->string();
    static constexpr std::string_view kPattern = "dddd-dd-dd";
    bool isDate = order.date.size() == kPattern.size();
    for (std::size_t i = 0; isDate && i < kPattern.size(); ++i) {
      const char c = order.date[i];
      isDate = kPattern[i] == 'd' ? c >= '0' && c <= '9' : c == kPattern[i];
    }
    if (!isDate) date->fail("a date is written like \"2024-05-31\"");
  }
  order.unknown = object.unknown();
  return order;
}

HandPlacement readHandPlacement(const JsonPlace& at) {
  constexpr double kFarthestMm = 1e5;
  JsonObject object(at);
  HandPlacement placement;
  placement.piece = readId(object.need("piece"));
  if (const auto move = object.find("move")) {
    placement.move = move->vector<2>();
    if (!(placement.move.cwiseAbs().maxCoeff() <= kFarthestMm)) {
      move->fail("a piece can be moved by at most 100 m");
    }
  }
  if (const auto turn = object.find("turn")) placement.turn = turn->parsed(parseAngle);
  placement.unknown = object.unknown();
  return placement;
}

std::vector<HandPlacement> readLayout(const JsonPlace& at) {
  std::vector<HandPlacement> layout;
  std::set<std::string> pieces;
  for (const JsonPlace& item : at.items()) {
    layout.push_back(readHandPlacement(item));
    if (!pieces.insert(layout.back().piece).second) {
      item.fail("the piece \"" + layout.back().piece + "\" is placed twice");
    }
  }
  return layout;
}

ModelReference readModelReference(const JsonPlace& at) {
  JsonObject object(at);
  ModelReference model;
  model.reference = readName(object.need("model"));
  if (const auto unit = object.find("unit")) {
    model.unit = unit->parsed(parseFileUnit, FileUnit::Millimetre);
  }
  if (const auto hash = object.find("connectivity")) model.connectivityHash = readHash(*hash);
  model.unknown = object.unknown();
  return model;
}

FinishSettings readFinish(const JsonPlace& at) {
  JsonObject object(at);
  FinishSettings finish;
  if (const auto found = object.find("allowance")) {
    finish.allowance = readLengthFrom(*found, Length());
  }
  if (const auto found = object.find("notchDepth")) {
    finish.notchDepth = readLengthFrom(*found, Length());
  }
  if (const auto found = object.find("notchSpacing")) {
    finish.notchSpacing = readLengthFrom(*found, Length(), false);
  }
  const auto allowance = [&](std::string_view key) -> std::optional<Length> {
    const auto found = object.find(key);
    if (!found) return std::nullopt;
    return readLengthFrom(*found, Length());
  };
  finish.hemAllowance = allowance("hemAllowance");
  finish.lappedAllowance = allowance("lappedAllowance");
  finish.openingAllowance = allowance("openingAllowance");
  if (const auto found = object.find("corner")) finish.corner = found->oneOf(kCornerStyleNames);
  if (const auto found = object.find("notchKind")) finish.notchKind = found->oneOf(kNotchKindNames);
  if (const auto found = object.find("notchWidth")) {
    finish.notchWidth = readLengthFrom(*found, Length(), false);
  }
  if (const auto found = object.find("halfOnFold")) finish.halfOnFold = found->boolean();
  finish.unknown = object.unknown();
  return finish;
}

/// Records of a list, each with an id of its own.
template <class Record>
std::vector<Record> readRecords(const std::optional<JsonPlace>& at,
                                Record (*read)(const JsonPlace&)) {
  std::vector<Record> out;
  if (!at) return out;
  std::set<std::string> ids;
  for (const JsonPlace& item : at->items()) {
    out.push_back(read(item));
    if (!ids.insert(out.back().id).second) {
      item.fail("the id \"" + out.back().id + "\" is used twice");
    }
  }
  return out;
}

// ---- references between records

/// The ids of the records that others may name.
class KnownIds {
 public:
  template <class Record>
  KnownIds(std::string_view what, const std::vector<Record>& records) : what_(what) {
    for (const Record& record : records) ids_.insert(record.id);
  }
  void check(const std::string& id, const JsonPlace& at) const {
    if (ids_.contains(id)) return;
    at.fail("there is no " + what_ + " \"" + id + "\"" +
            suggestion(id, std::vector<std::string>(ids_.begin(), ids_.end())));
  }
  void check(const Place& place, const JsonPlace& at) const {
    detail::forEachOfKind<OnStylingCurve>(
        place, [&](const OnStylingCurve& onLine) { check(onLine.id, at); });
  }

 private:
  std::string what_;
  std::set<std::string> ids_;
};

void checkCurveReferences(const StylingCurve& curve, const KnownIds& curves, const JsonPlace& at) {
  if (curve.mirrorOf) {
    curves.check(*curve.mirrorOf, at);
    if (*curve.mirrorOf == curve.id) at.fail("a curve cannot be the mirror image of itself");
  }
  const std::vector<Place>* controls = nullptr;
  if (const auto* smooth = std::get_if<SmoothWay>(&curve.way)) controls = &smooth->controls;
  if (const auto* shortest = std::get_if<ShortestWay>(&curve.way)) controls = &shortest->controls;
  if (controls == nullptr) return;
  for (const Place& place : *controls) curves.check(place, at);
}

void checkReferences(const Design& design, JsonObject& root) {
  const KnownIds curves("curve", design.curves);
  const KnownIds fabrics("fabric", design.fabrics);
  const KnownIds pieces("piece", design.pieces);
  for (std::size_t i = 0; i < design.curves.size(); ++i) {
    checkCurveReferences(design.curves[i], curves, root.need("curves").item(i));
  }
  for (std::size_t i = 0; i < design.pieces.size(); ++i) {
    const JsonPlace at = root.need("pieces").item(i);
    curves.check(design.pieces[i].anchor, at);
    if (!design.pieces[i].fabric.empty()) fabrics.check(design.pieces[i].fabric, at);
    if (!design.pieces[i].twin) continue;
    pieces.check(design.pieces[i].twin->of, at);
    if (design.pieces[i].twin->of == design.pieces[i].id) at.fail("a piece is no twin of itself");
  }
}

void checkVersion(JsonObject& root) {
  const JsonPlace stamp = root.need("toile");
  if (stamp.fault->error()) return;
  const std::uint32_t version = stamp.index();
  if (version == 0) stamp.fail("must be the version of the format, 1 or more");
  if (version > static_cast<std::uint32_t>(kDesignFormatVersion)) {
    stamp.fail("a newer Toile wrote this file (format " + std::to_string(version) +
               "; this one reads up to " + std::to_string(kDesignFormatVersion) + ")");
  }
}

Design readRoot(JsonObject& root) {
  Design design;
  checkVersion(root);
  if (root.place().fault->error()) return design;
  design.name = root.text("name");
  if (const auto models = root.find("models")) {
    for (const JsonPlace& item : models->items()) design.models.push_back(readModelReference(item));
  }
  design.curves = readRecords(root.find("curves"), readCurve);
  design.pieces = readRecords(root.find("pieces"), readPiece);
  design.fabrics = readRecords(root.find("fabrics"), readFabric);
  if (const auto order = root.find("order")) design.order = readOrder(*order);
  if (const auto finish = root.find("finish")) design.finish = readFinish(*finish);
  if (const auto layout = root.find("layout")) design.layout = readLayout(*layout);
  design.unknown = root.unknown();
  if (!root.place().fault->error()) checkReferences(design, root);
  return design;
}

}  // namespace

Result<Design> parseDesign(std::string_view json, const std::string& file) {
  const Result<JsonValue> value = parseJson(json, file);
  if (!value) return value.error();
  JsonFault fault(file);
  JsonObject root({&*value, "", &fault});
  Design design = readRoot(root);
  if (fault.error()) return *fault.error();
  return design;
}

Result<Design> readDesign(const std::filesystem::path& path) {
  const Result<std::string> content = readFile(path, JsonLimits().bytes);
  if (!content) return content.error();
  return parseDesign(*content, path.string());
}

}  // namespace toile
