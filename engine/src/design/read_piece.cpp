// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "design/design_names.h"
#include "design/read_records.h"
#include "design/read_values.h"

namespace toile::detail {
namespace {

constexpr std::uint32_t kMaxCount = 10000;

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

}  // namespace

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
    fabric.allowance = readAllowance(*allowance);
  }
  if (const auto turns = object.find("turns")) fabric.turns = turns->oneOf(kTurnsNames);
  if (const auto ease = object.find("ease")) fabric.ease = readEase(*ease);
  fabric.unknown = object.unknown();
  return fabric;
}

}  // namespace toile::detail
