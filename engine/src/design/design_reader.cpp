// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "design/design_names.h"
#include "design/json_object.h"
#include "design/read_records.h"
#include "design/read_values.h"
#include "design/single_places.h"
#include "toile/core/file.h"
#include "toile/design/design_file.h"
#include "toile/design/finish_limits.h"

namespace toile {
namespace {

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
  placement.piece = detail::readId(object.need("piece"));
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
  model.reference = detail::readName(object.need("model"));
  if (const auto unit = object.find("unit")) {
    model.unit = unit->parsed(parseFileUnit, FileUnit::Millimetre);
  }
  if (const auto hash = object.find("connectivity"))
    model.connectivityHash = detail::readHash(*hash);
  model.unknown = object.unknown();
  return model;
}

FinishSettings readFinish(const JsonPlace& at) {
  JsonObject object(at);
  FinishSettings finish;
  if (const auto found = object.find("allowance")) {
    finish.allowance = detail::readAllowance(*found);
  }
  if (const auto found = object.find("notchDepth")) {
    finish.notchDepth = detail::readLengthIn(*found, Length(), kMostNotchSize);
  }
  if (const auto found = object.find("notchSpacing")) {
    finish.notchSpacing = detail::readLengthIn(*found, kLeastNotchSpacing, kMostNotchSpacing);
  }
  const auto allowance = [&](std::string_view key) -> std::optional<Length> {
    const auto found = object.find(key);
    if (!found) return std::nullopt;
    return detail::readAllowance(*found);
  };
  finish.hemAllowance = allowance("hemAllowance");
  finish.lappedAllowance = allowance("lappedAllowance");
  finish.openingAllowance = allowance("openingAllowance");
  if (const auto found = object.find("corner")) finish.corner = found->oneOf(kCornerStyleNames);
  if (const auto found = object.find("notchKind")) finish.notchKind = found->oneOf(kNotchKindNames);
  if (const auto found = object.find("notchWidth")) {
    finish.notchWidth = detail::readLengthIn(*found, kLeastNotchWidth, kMostNotchSize);
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
  design.curves = readRecords(root.find("curves"), detail::readCurve);
  design.pieces = readRecords(root.find("pieces"), detail::readPiece);
  design.fabrics = readRecords(root.find("fabrics"), detail::readFabric);
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
