// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "toile/design/design.h"
#include "toile/design/finish_limits.h"

namespace toile::test {

/// Designs that use every part of the file format, with awkward numbers and texts. The generator's
/// raw output only, so that a seed means the same design everywhere.
class RandomDesign {
 public:
  explicit RandomDesign(unsigned seed) : random_(seed) {}

  Design design() {
    Design design;
    design.name = text();
    for (std::size_t i = below(3); i > 0; --i) {
      ModelReference model{"body-" + text(), std::nullopt, std::nullopt, unknown()};
      if (chance()) model.unit = static_cast<FileUnit>(below(4));
      if (chance()) model.connectivityHash = ContentHash{{bits(), bits()}};
      design.models.push_back(model);
    }
    for (std::size_t i = below(5); i > 0; --i) design.curves.push_back(curve(design));
    for (std::size_t i = below(3); i > 0; --i) design.fabrics.push_back(fabric(design));
    for (std::size_t i = below(4); i > 0; --i) design.pieces.push_back(piece(design));
    if (chance()) design.order = {text(), text(), text(), "2024-02-29", unknown()};
    design.finish = finish();
    while (chance()) {
      design.layout.push_back({newId("p"),
                               {100 * (fraction() - 0.5), 100 * (fraction() - 0.5)},
                               Angle::degrees(360 * fraction()),
                               unknown()});
    }
    design.unknown = unknown();
    return design;
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  std::uint64_t bits() { return (std::uint64_t{random_()} << 32) | random_(); }
  bool chance() { return below(2) == 0; }
  /// 0 < t < 1, all 53 bits in use.
  double fraction() { return static_cast<double>((bits() >> 11) | 1) * 0x1p-53; }
  double number() {
    static constexpr std::array kAwkward{0.0,    -0.0,    0.1,   1.0 / 3,  1e300,
                                         5e-324, 1e22,    -1e-7, 123456.0, 0x1.fffffffffffffp-1,
                                         1e15,   -2.5e16, 9.6e-5};
    if (chance()) return kAwkward[below(kAwkward.size())];
    return std::ldexp(fraction() - 0.5, static_cast<int>(below(40)) - 20);
  }
  Length within(Length low, Length high) {
    const double mm = low.mm() + fraction() * (high.mm() - low.mm());
    return chance() ? Length::mm(mm) : chance() ? low : high;
  }
  std::string text() {
    static const std::array<std::string, 6> kTexts{"",
                                                   "front",
                                                   "Ärmel \"links\" \\ 8\xC2\xBD",
                                                   "two\nlines\tand \x01 a bell",
                                                   "\xF0\x9F\xA7\xB5 thread",
                                                   "/a~b/"};
    return kTexts[below(kTexts.size())];
  }
  UnknownKeys unknown() {
    UnknownKeys out;
    if (below(3) == 0) out["later"] = "1.50e+3";
    if (below(3) == 0) out["note \"x\""] = "{\"a\": [1, 2,\n   true, null], \"b\":\"\\u00e9\"}";
    return out;
  }
  Eigen::Vector3d vector() { return {number(), number(), 1 + std::abs(number())}; }
  std::string newId(const char* stem) { return stem + std::to_string(++ids_) + "_x-Y"; }

  ModelPoint modelPoint() {
    const std::size_t kind = below(3);
    if (kind == 0) return {VertexId(below(100000))};
    if (kind == 1) {
      const std::size_t tail = below(1000);
      return {ModelPoint::OnEdge{VertexId(tail), VertexId(tail + 1 + below(9)), fraction()}};
    }
    const double a = fraction(), b = (1 - a) * fraction();
    return {SurfacePoint::InFace{FaceId(below(100000)), {a, b, 1 - a - b}}};
  }
  SectionPlane plane() {
    SectionPlane plane;
    plane.normal = vector();
    if (chance()) {
      plane.through = AtLandmark{"hip_front"};
    } else if (chance()) {
      plane.through = modelPoint();
    } else {
      plane.through = Length::mm(number());
    }
    plane.unknown = unknown();
    return plane;
  }
  SinglePlace singlePlace(const Design& design) {
    switch (below(7)) {
      case 0:
        return AtLandmark{"waist_front", unknown()};
      case 1:
        return OnModelCurve{"side_l", fraction(), unknown()};
      case 2:
        if (design.curves.empty()) return modelPoint();
        return OnStylingCurve{design.curves[below(design.curves.size())].id, 1, unknown()};
      case 3:
        return OnSection{plane(), vector(), unknown()};
      case 4:
        return NearPosition{vector(), unknown()};
      default:
        return modelPoint();
    }
  }
  Place place(const Design& design) {
    if (below(5) == 0) {
      return BetweenPlaces{{singlePlace(design), singlePlace(design)}, fraction(), unknown()};
    }
    return std::visit([](const auto& single) { return Place(single); }, singlePlace(design));
  }
  std::vector<Place> places(const Design& design) {
    std::vector<Place> out;
    for (std::size_t i = 1 + below(4); i > 0; --i) out.push_back(place(design));
    return out;
  }
  CurveWay way(const Design& design) {
    const auto rule = static_cast<SubdivisionRule>(below(3));
    switch (below(7)) {
      case 0:
        return SmoothWay{places(design), rule,
                         chance() ? std::vector<std::size_t>{0} : std::vector<std::size_t>{},
                         unknown()};
      case 1: {
        ViewWay way;
        way.view = {vector(), vector(), vector(), 1 + std::abs(number()), chance()};
        for (std::size_t i = below(4); i > 0; --i) way.controls.emplace_back(number(), number());
        way.rule = rule;
        if (!way.controls.empty()) way.corners = {way.controls.size() - 1};
        way.unknown = unknown();
        way.unknownOfView = unknown();
        return way;
      }
      case 2:
        return AlongModelCurve{"centre_back", fraction(), 0, unknown()};
      case 3: {
        AlongVertices way;
        for (std::size_t i = below(4); i > 0; --i) way.vertices.emplace_back(below(5000));
        way.unknown = unknown();
        return way;
      }
      case 4:
        return AlongSection{plane(), unknown()};
      default:
        return ShortestWay{places(design), unknown()};
    }
  }
  FinishSettings finish() {
    FinishSettings finish;
    finish.allowance = within(Length(), kMostAllowance);
    finish.notchDepth = within(Length(), kMostNotchSize);
    finish.notchSpacing = within(kLeastNotchSpacing, kMostNotchSpacing);
    if (chance()) finish.hemAllowance = within(Length(), kMostAllowance);
    if (chance()) finish.lappedAllowance = within(Length(), kMostAllowance);
    if (chance()) finish.openingAllowance = within(Length(), kMostAllowance);
    finish.corner = static_cast<CornerStyle>(below(4));
    finish.notchKind = static_cast<NotchKind>(below(6));
    if (chance()) finish.notchWidth = within(kLeastNotchWidth, kMostNotchSize);
    finish.halfOnFold = chance();
    finish.unknown = unknown();
    return finish;
  }
  SeamSide side() {
    SeamSide side;
    if (chance()) side.allowance = within(Length(), kMostAllowance);
    side.kind = static_cast<SeamKind>(below(3));
    if (chance()) side.corner = static_cast<CornerStyle>(below(4));
    side.unknown = unknown();
    return side;
  }
  StylingCurve curve(const Design& design) {
    StylingCurve curve;
    curve.id = newId("c");
    curve.name = text();
    curve.kind = static_cast<CurveKind>(below(7));
    curve.closed = chance();
    const bool hasWay = chance();
    if (hasWay) curve.way = way(design);
    for (std::size_t i = below(4); i > 0; --i) curve.dataPoints.push_back(modelPoint());
    if (!design.curves.empty() && chance()) curve.mirrorOf = design.curves.front().id;
    if (!hasWay && !curve.mirrorOf) curve.dataPoints.push_back(modelPoint());
    if (chance()) curve.elasticRange = Ratio::of(fraction());
    curve.left = side();
    curve.right = side();
    curve.unknown = unknown();
    return curve;
  }
  Ease ease() {
    Ease ease;
    ease.girth = Ratio::of(fraction() - 0.5);
    ease.length = chance() ? ease.girth : Ratio::of(fraction() - 0.5);
    if (chance()) ease.along = chance() ? "x" : "arm_outer_l";
    ease.unknown = unknown();
    return ease;
  }
  DevelopSetting developSetting() {
    DevelopSetting setting;
    (chance() ? setting.amount : setting.maxAreaError) = Ratio::of(0.25 + fraction() / 2);
    if (chance()) setting.gap = Length::mm(std::abs(number()));
    setting.unknown = unknown();
    return setting;
  }
  PieceRecord piece(const Design& design) {
    PieceRecord piece;
    piece.id = newId("p");
    piece.name = text();
    piece.anchor = place(design);
    piece.include = chance();
    piece.count = static_cast<int>(1 + below(3));
    if (!design.fabrics.empty() && chance()) piece.fabric = design.fabrics.front().id;
    if (chance()) piece.ease = ease();
    if (chance()) piece.develop = developSetting();
    if (chance()) piece.grain = {Grain::Axis::X, Angle::radians(fraction()), unknown()};
    if (chance() && !design.pieces.empty()) {
      piece.twin = {design.pieces.front().id, TwinMode::Mean, unknown()};
    }
    for (const StylingCurve& curve : design.curves) piece.boundary.push_back(curve.id);
    piece.unknown = unknown();
    return piece;
  }
  Fabric fabric(const Design&) {
    Fabric fabric;
    fabric.id = newId("f");
    fabric.name = text();
    if (chance()) fabric.colour = "#1a2B3c";
    if (chance()) fabric.stretchAlong = Ratio::of(fraction());
    if (chance()) fabric.stretchAcross = Ratio::of(fraction());
    if (chance()) fabric.shear = Ratio::of(fraction());
    if (chance()) {
      fabric.weights = {1 + fraction(), 2 + fraction(), 0.1 + fraction(), unknown()};
    }
    fabric.thickness = Length::mm(std::abs(number()));
    if (chance()) fabric.rollWidth = Length::mm(1 + std::abs(number()));
    if (chance()) fabric.allowance = within(Length(), kMostAllowance);
    if (chance()) fabric.turns = chance() ? Turns::OneWay : Turns::Any;
    fabric.thicknessOffset = Ratio::of(fraction());
    fabric.ease = ease();
    fabric.unknown = unknown();
    return fabric;
  }

  std::mt19937 random_;
  int ids_ = 0;
};

}  // namespace toile::test
