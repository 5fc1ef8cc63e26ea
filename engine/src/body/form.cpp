// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/form.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "body/even_parameters.h"
#include "body/form_tables.h"

// Lengths are thousandths of the body's height; y is to the back, z counts from the floor.
namespace toile::body {
namespace {

using Eigen::Vector3d;

std::size_t at(BodyMeasure measure) {
  return static_cast<std::size_t>(measure);
}

constexpr double kPi = std::numbers::pi;

double mix(double a, double b, double t) {
  return a + (b - a) * t;
}
double powSigned(double x, double p) {
  return x < 0 ? -std::pow(-x, p) : std::pow(x, p);
}

/// Scale of the rings, from the dials of those that are measured.
double blended(const Dials& dials, BodyMeasure a, BodyMeasure b, double t) {
  return std::exp(mix(dials[at(a)], dials[at(b)], t));
}

class Builder {
 public:
  Builder(const Form& form, double height, const Dials& dials)
      : form_(form),
        unit_(height / 1000 * std::exp(dials[at(BodyMeasure::Height)])),
        dials_(dials),
        points_(controlNet().vertexCount(), 3) {
    points_.setZero();
    // The height's dial has turned the unit; the others add to what the form has by itself.
    for (const BodyMeasureInfo& info : bodyMeasures()) {
      dials_[at(info.measure)] += form.childlike * childOffset(info.measure);
    }
  }
  Points build() {
    placeHeights();
    buildLegs();
    buildTrunk();
    buildShoulders();
    buildNeckAndHead();
    buildArms();
    buildFeet();
    mirror();
    return points_;
  }

 private:
  [[nodiscard]] double blend(double female, double male) const {
    return mix(female, male, form_.masculine);
  }
  [[nodiscard]] double factor(BodyMeasure m) const { return std::exp(dials_[at(m)]); }
  void set(NetVertex v, const Vector3d& place) {
    points_.row(static_cast<Eigen::Index>(v)) = unit_ * place.transpose();
  }
  [[nodiscard]] Vector3d get(NetVertex v) const {
    return points_.row(static_cast<Eigen::Index>(v)).transpose() / unit_;
  }

  // ---- heights
  void placeHeights() {
    const double child = form_.childlike;
    const double crotch = mix(462, 425, child) * factor(BodyMeasure::InsideLeg);
    const double neck = mix(852, 818, child);
    const double waist = neck - mix(206, 214, child) * factor(BodyMeasure::BackLength);
    const double chin = mix(872, 838, child);
    from_ = {0, 50, 280, 462, 646, 852, 872, 1000};
    to_ = {0, 50, 280.0 / 462 * crotch, crotch, waist, neck, chin, 1000};
  }
  /// Height of what stands at z on the standard body.
  [[nodiscard]] double level(double z) const {
    std::size_t i = 1;
    while (i + 1 < from_.size() && z > from_[i]) ++i;
    return mix(to_[i - 1], to_[i], (z - from_[i - 1]) / (from_[i] - from_[i - 1]));
  }

  // ---- trunk
  [[nodiscard]] TrunkRing trunkRing(std::size_t row) const {
    const TrunkRing& f = kFemaleTrunk[row];
    const TrunkRing& m = kMaleTrunk[row];
    TrunkRing ring{level(f.z),
                   blend(f.width, m.width),
                   blend(f.widestY, m.widestY),
                   blend(f.front, m.front),
                   blend(f.back, m.back),
                   blend(f.squareFront, m.squareFront),
                   blend(f.squareBack, m.squareBack),
                   blend(f.frontGroove, m.frontGroove),
                   blend(f.backGroove, m.backGroove)};
    // Flesh gathers in front: the ring grows about a place near the spine; at the chest it grows
    // more in depth than in width. Depths follow the rings above and below, so that the profile
    // stays smooth where one girth is unusual.
    const double grow = trunkGrowth(row);
    double calm = grow;
    if (row >= kHighHipRow && row <= kUnderbustRow) {
      calm = 0.5 * grow + 0.25 * (trunkGrowth(row - 1) + trunkGrowth(row + 1));
    }
    const bool isChest = row >= kBustRow;
    const double pivot = mix(ring.back, ring.front, 0.4);
    const double wide = std::exp((isChest ? 0.65 : 0.97) * (2 * grow - calm));
    const double deep = std::exp((isChest ? 1.3 : 1.04) * calm);
    ring.width *= wide;
    // Under the arm there is no more room than the shoulder leaves.
    if (isChest) ring.width = std::min(ring.width, shoulderPoint().x() + 4);
    ring.front = pivot + (ring.front - pivot) * deep;
    ring.back = pivot + (ring.back - pivot) * deep;
    ring.widestY = pivot + (ring.widestY - pivot) * deep;
    return ring;
  }
  /// Log of how much a ring is larger than the form's own.
  [[nodiscard]] double trunkGrowth(std::size_t row) const {
    const auto dial = [&](BodyMeasure m) { return dials_[at(m)]; };
    switch (row) {
      case kHipRow:
        return dial(BodyMeasure::Hip);
      case kHighHipRow:
        return dial(BodyMeasure::HighHip);
      case kAbdomenRow:
        return 0.5 * (dial(BodyMeasure::HighHip) + dial(BodyMeasure::Waist));
      case kWaistRow:
        return dial(BodyMeasure::Waist);
      case kUnderbustRow:
        return dial(BodyMeasure::Underbust);
      case kBustRow:
        return chest();
      default:
        return 0.8 * chest();
    }
  }
  /// Growth of the ring at the bust: with the ribs below and, more so for a man, by its own dial,
  /// which also turns the breasts.
  [[nodiscard]] double chest() const {
    return blend(0.85, 0.55) * dials_[at(BodyMeasure::Underbust)] +
           blend(0.3, 0.5) * dials_[at(BodyMeasure::Chest)];
  }
  [[nodiscard]] Vector3d onRing(const TrunkRing& ring, std::size_t column) const {
    const double t = static_cast<double>(column) / kBackColumn * kPi;
    const double c = std::cos(t), s = std::sin(t);
    const bool isFront = column <= kSideColumn;
    const double n = 2 / (isFront ? ring.squareFront : ring.squareBack);
    const double x = column % kBackColumn == 0 ? 0 : ring.width * std::pow(s, n);
    const double depth = isFront ? ring.widestY - ring.front : ring.back - ring.widestY;
    double y = ring.widestY - depth * powSigned(column == kSideColumn ? 0 : c, n);
    const double groove = isFront ? ring.frontGroove : -ring.backGroove;
    y += groove * std::exp(-std::pow(x / 24, 2));
    return {x, y, ring.z};
  }
  void buildTrunk() {
    for (std::size_t row = kSplitRow; row <= kArmpitRow; ++row) {
      TrunkRing ring = trunkRing(row);
      if (row == kSplitRow) {
        // Between hip and thigh, whose sizes are given.
        const TrunkRing hip = trunkRing(kHipRow);
        const LegRing thigh = legRing(kThighRow);
        ring.width = mix(hip.width, thigh.outer, 0.6) + 1;
        ring.front = mix(hip.front, thigh.front, 0.6);
        ring.back = mix(hip.back, thigh.back, 0.45);
        ring.widestY = mix(hip.widestY, 0.5 * (thigh.front + thigh.back), 0.6);
      }
      trunk_[row] = ring;
      for (std::size_t column = 0; column <= kBackColumn; ++column) {
        set(controlNet().torso(row, column), onRing(ring, column));
      }
    }
    set(controlNet().crotch(), {0, blend(-24, -14), level(462)});
    addBreasts();
  }
  void addBreasts() {
    const double adult = 1 - form_.childlike;
    const double turn = dials_[at(BodyMeasure::Chest)];
    const double size = blend(24.0, 3.5) * adult * std::exp(blend(1.8, 0.5) * turn);
    const double wide = std::exp(0.5 * chest() + 0.35 * turn);
    const double middleX = 0.58 * trunk_[kBustRow].width, middleZ = level(728);
    for (std::size_t row = kUnderbustRow; row <= kHighChestRow; ++row) {
      // The rim of the arm's opening stays.
      const std::size_t last = row < kArmpitRow ? kSideColumn : kSideColumn - 2;
      for (std::size_t column = 0; column <= last; ++column) {
        const NetVertex v = controlNet().torso(row, column);
        Vector3d place = get(v);
        const double dx = (place.x() - middleX) / (29 * wide);
        const double dz =
            (place.z() - middleZ) / (place.z() > middleZ ? 27 * wide : 23 * wide * wide);
        // Above the armpit it runs out towards the arm.
        const double s = place.x() / shoulderPoint().x();
        const double fade = row < kArmpitRow ? 1.0 : std::max(0.0, 1 - std::pow(s, 3));
        place.y() -= size * fade * std::exp(-dx * dx - dz * dz);
        set(v, place);
      }
    }
  }

  // ---- shoulders
  [[nodiscard]] Vector3d shoulderPoint() const {
    const double out = blend(41, 47) * factor(BodyMeasure::NeckBase) +
                       blend(65, 62) * factor(BodyMeasure::ShoulderLength);
    return {out, blend(-9, -10), level(blend(823, 829))};
  }
  void buildShoulders() {
    const ControlNet& net = controlNet();
    const Vector3d top = shoulderPoint();
    // Rim of the arm's opening: about a circle in a plane that faces sideways.
    const double size = factor(BodyMeasure::Armscye);
    // It grows to front and back more than down, where the bust's ring is near.
    const double radiusY = blend(38, 42) * std::pow(size, 1.4);
    const double radiusZ =
        std::min(blend(34, 37) * std::pow(size, 0.6), 0.5 * (top.z() - trunk_[kBustRow].z - 17));
    // A full chest pushes the arm outwards, below more than above.
    const double lean = std::clamp(top.x() - 3 - trunk_[kBustRow].width, -8.0, blend(8, 10));
    for (std::size_t spoke = 0; spoke < kArmSpokes; ++spoke) {
      const double t = 2 * kPi * static_cast<double>(spoke) / kArmSpokes;
      const double down = 0.5 * (1 - std::cos(t));
      const Vector3d place(
          top.x() - lean * down - 3 * std::sin(t) * (spoke < 5 ? 1 : 0),
          top.y() - radiusY * std::sin(t) + blend(-2, 2) * std::sin(t) * std::sin(t),
          top.z() - 2 * radiusZ * down);
      set(net.arm(Side::Left, 0, spoke), place);
    }
    const double deep = std::exp(0.8 * chest());
    struct Level {
      double frontY, frontZ, backY, backZ;
    };
    const std::array<Level, 3> levels{{
        {blend(-73, -70), 768, blend(31, 49), 773},
        {blend(-66, -63), 782, blend(30.5, 48), 791},
        {blend(-58, -56), 796, blend(28, 43), 808},
    }};
    const TrunkRing& armpit = trunk_[kArmpitRow];
    const double pivot = mix(armpit.back, armpit.front, 0.4);
    for (std::size_t row = kArmpitRow; row <= kShoulderRow; ++row) {
      double frontY = armpit.front, frontZ = armpit.z;
      double backY = armpit.back, backZ = armpit.z;
      if (row > kArmpitRow) {
        const Level& there = levels[row - kLowChestRow];
        const double fade = mix(deep, 1, 0.3 * static_cast<double>(row - kArmpitRow));
        frontY = pivot + (there.frontY - pivot) * fade,
        backY = pivot + (there.backY - pivot) * fade;
        frontZ = level(there.frontZ), backZ = level(there.backZ);
      }
      const Vector3d front = get(net.torso(row, kSideColumn - 1));
      const Vector3d back = get(net.torso(row, kSideColumn + 1));
      static constexpr std::array<double, 4> kParts{0, 0.28, 0.56, 0.82};
      for (std::size_t i = 0; i < kParts.size(); ++i) {
        const double s = kParts[i];
        const double bend = std::pow(s, row == kArmpitRow ? 5.0 : 2.6), lift = std::pow(s, 2.0);
        const NetVertex f = net.torso(row, i), b = net.torso(row, kBackColumn - i);
        set(f, {s * front.x(), mix(frontY, front.y(), bend), mix(frontZ, front.z(), lift)});
        const double spine = armpit.backGroove *
                             (1 - 0.17 * static_cast<double>(row - kArmpitRow)) *
                             std::exp(-std::pow(s * back.x() / 24, 2));
        set(b, {s * back.x(), mix(backY, back.y(), bend) - spine, mix(backZ, back.z(), lift)});
      }
    }
  }

  // ---- neck and head
  struct TiltedRing {
    double frontY, frontZ, sideX, sideY, sideZ, backY, backZ, squareFront, squareBack;
  };
  void setTilted(std::size_t row, const TiltedRing& ring) {
    for (std::size_t column = 0; column <= kBackColumn; ++column) {
      const double t = static_cast<double>(column) / kBackColumn * kPi;
      const bool isFront = column <= kSideColumn;
      const double n = 2 / (isFront ? ring.squareFront : ring.squareBack);
      const double x = column % kBackColumn == 0 ? 0 : ring.sideX * std::pow(std::sin(t), n);
      const double part = column == kSideColumn ? 0 : std::pow(std::abs(std::cos(t)), n);
      const double y = mix(ring.sideY, isFront ? ring.frontY : ring.backY, part);
      const double z = mix(ring.sideZ, isFront ? ring.frontZ : ring.backZ, part);
      set(controlNet().torso(row, column), {x, y, z});
    }
  }
  void buildNeckAndHead() {
    const double base = factor(BodyMeasure::NeckBase), neck = factor(BodyMeasure::Neck),
                 head = factor(BodyMeasure::Head);
    const double throat = std::sqrt(neck * head);
    const Vector3d top = shoulderPoint();
    const double neckX = blend(41, 47) * base;
    const double neckZ = level(848);
    const double y0 = -16;
    const auto about = [&](double y, double s) { return y0 + (y - y0) * s; };
    const double baseDepth = std::sqrt(base);
    {
      // Half-way between neck and shoulder the ring runs over the trapezius.
      const double t = 0.39;
      setTilted(kMidShoulderRow,
                {about(blend(-47, -49), baseDepth) - blend(6, 3), level(806),
                 mix(neckX, top.x(), t), blend(-6, -7), mix(neckZ, top.z(), t) + 1,
                 about(blend(14, 18), baseDepth) + blend(10, 16), level(828), 2.3, 2.3});
    }
    setTilted(kNeckBaseRow, {about(blend(-47, -49), baseDepth), level(818), neckX, -3, neckZ,
                             about(blend(14, 18), baseDepth), level(852), 2.1, 2.1});
    const double chin = to_[6], crown = 1000;
    const auto headZ = [&](double part) { return mix(chin, crown, part); };
    const double neckFrontZ = mix(level(818), chin, 0.62),
                 neckBackZ = mix(level(852), headZ(0.2), 0.6);
    const auto betweenBaseAndNeck = [&](double a, double b) { return mix(a, b, 0.58); };
    const double neckSideZ = 0.5 * (neckFrontZ + neckBackZ);
    setTilted(
        kLowNeckRow,
        {betweenBaseAndNeck(about(blend(-47, -49), baseDepth), about(blend(-44.5, -46), neck)) + 2,
         betweenBaseAndNeck(level(818), neckFrontZ), mix(neckX, blend(33.5, 37.5) * neck, 0.78),
         betweenBaseAndNeck(-3, about(-15, neck)), betweenBaseAndNeck(neckZ, neckSideZ) + 3,
         betweenBaseAndNeck(about(blend(14, 18), baseDepth), about(blend(10, 13.5), neck)) - 0.5,
         betweenBaseAndNeck(level(852), neckBackZ), 2.1, 2.1});
    setTilted(kNeckRow,
              {about(blend(-44.5, -46), neck), neckFrontZ, blend(33.5, 37.5) * neck,
               about(-15, neck), neckSideZ, about(blend(10, 13.5), neck), neckBackZ, 2.1, 2.1});
    const double yh = -30;
    const auto in = [&](double y) { return yh + (y - yh) * head; };
    setTilted(kThroatRow, {mix(about(-46, neck), in(-66), 0.6), headZ(-0.02),
                           mix(blend(30, 36) * throat, 33 * head, 0.5), in(-22), headZ(0.09), in(8),
                           headZ(0.2), 2.0, 2.1});
    setTilted(kChinRow, {in(-84), headZ(0.04), blend(36, 38) * head, in(-30), headZ(0.18), in(14),
                         headZ(0.34), 1.75, 2.1});
    setTilted(kFaceRow, {in(-91), headZ(0.27), 42.5 * head, in(-30.5), headZ(0.37), in(24),
                         headZ(0.50), 1.95, 2.1});
    setTilted(kForeheadRow, {in(-89), headZ(0.54), 44.5 * head, in(-28.5), headZ(0.58), in(27),
                             headZ(0.64), 2.1, 2.1});
    setTilted(kUpperHeadRow, {in(-76), headZ(0.80), 38 * head, in(-27.5), headZ(0.81), in(18),
                              headZ(0.82), 2.1, 2.1});
    for (std::size_t along = 1; along < kCrownAlong; ++along) {
      for (std::size_t across = 2; across < kCrownAcross; ++across) {
        const double u = (static_cast<double>(across) - 2) / 2;
        const double v = (static_cast<double>(along) - 3) / 3;
        // Square to disc, so that the rim keeps its places.
        const double x = u * std::sqrt(1 - 0.5 * v * v), y = v * std::sqrt(1 - 0.5 * u * u);
        const double up = 1 - x * x - y * y;
        set(controlNet().crown(across, along),
            {38 * head * x, in(-29 + 47 * y), mix(headZ(0.81), crown, std::pow(up, 0.68))});
      }
    }
  }

  // ---- arms
  [[nodiscard]] double armScale(std::size_t row) const {
    switch (row) {
      case 1:
        return blended(dials_, BodyMeasure::Armscye, BodyMeasure::UpperArm, 0.4);
      case 2:
        return blended(dials_, BodyMeasure::Armscye, BodyMeasure::UpperArm, 0.75);
      case 3:
      case kUpperArmRow:
        return factor(BodyMeasure::UpperArm);
      case 5:
        return blended(dials_, BodyMeasure::UpperArm, BodyMeasure::Elbow, 0.5);
      case kElbowRow:
        return factor(BodyMeasure::Elbow);
      case kWristRow:
        return factor(BodyMeasure::Wrist);
      default:
        if (row > kWristRow) return std::exp(0.5 * dials_[at(BodyMeasure::Wrist)]);
        return blended(dials_, BodyMeasure::Elbow, BodyMeasure::Wrist,
                       (static_cast<double>(row) - kElbowRow) / (kWristRow - kElbowRow));
    }
  }
  void buildArms() {
    const ControlNet& net = controlNet();
    Vector3d middle = Vector3d::Zero();
    for (std::size_t i = 0; i < kArmSpokes; ++i)
      middle += get(net.arm(Side::Left, 0, i)) / kArmSpokes;
    const double length = factor(BodyMeasure::ArmLength) * mix(1.0, 0.95, form_.childlike);
    const double thick = blend(1, 1.12);
    // The arm leaves the opening at right angles; 13 degrees below level on a usual body.
    const Vector3d rim =
        get(net.arm(Side::Left, 0, kArmOuter)) - get(net.arm(Side::Left, 0, kArmInner));
    const double rimFall = std::atan2(rim.x(), rim.z()) * 180 / kPi + 4;
    for (std::size_t row = 1; row <= kFingerRow; ++row) {
      const ArmRing& ring = kFemaleArm[row - 1];
      // The arm turns down from the opening, then a little forwards at the elbow.
      const auto fall = [&](double r) { return mix(rimFall, 48.0, std::clamp(r / 3.6, 0.0, 1.0)); };
      const auto ahead = [](double r) {
        return 14.0 * std::clamp((r - 5.5) / 3.0, 0.0, 1.0) + 0.0;
      };
      const double r = static_cast<double>(row);
      const auto direction = [&](double where) {
        const double a = fall(where) * kPi / 180, b = ahead(where) * kPi / 180;
        return Vector3d(std::cos(b) * std::cos(a), -std::sin(b), -std::cos(b) * std::sin(a));
      };
      const double stretch =
          row <= kWristRow ? length : std::exp(0.5 * dials_[at(BodyMeasure::ArmLength)]);
      // A stout arm needs more length to turn in.
      const double room = row <= 3 ? std::max(1.0, thick * armScale(row)) : 1.0;
      middle += ring.step * stretch * room * direction(r - 0.5);
      const Vector3d along = direction(r);
      const Vector3d outer = Vector3d(-along.z(), 0, along.x()).normalized();  // up and outwards
      const Vector3d front = along.cross(outer).normalized();
      const double scale = armScale(row) * (row <= kWristRow ? thick : blend(1, 1.08));
      const auto section = [&](double t) {
        const double c = std::cos(t), s = std::sin(t);
        return Eigen::Vector2d(c * (c > 0 ? ring.outer : ring.inner),
                               s * (s > 0 ? ring.front : ring.back));
      };
      const std::vector<double> turns = evenParameters(section, kArmSpokes);
      for (std::size_t spoke = 0; spoke < kArmSpokes; ++spoke) {
        const Eigen::Vector2d here = section(turns[spoke]);
        set(net.arm(Side::Left, row, spoke),
            middle + scale * (here.x() * outer + here.y() * front));
      }
    }
  }

  // ---- legs and feet
  [[nodiscard]] double legScale(std::size_t row) const {
    switch (row) {
      case kThighRow:
        return factor(BodyMeasure::Thigh);
      case 2:
        return blended(dials_, BodyMeasure::Thigh, BodyMeasure::MidThigh, 0.5);
      case kMidThighRow:
        return factor(BodyMeasure::MidThigh);
      case 4:
        return blended(dials_, BodyMeasure::MidThigh, BodyMeasure::Knee, 0.55);
      case kKneeRow:
        return factor(BodyMeasure::Knee);
      case 6:
        return blended(dials_, BodyMeasure::Knee, BodyMeasure::Calf, 0.5);
      case kCalfRow:
        return factor(BodyMeasure::Calf);
      default:
        return blended(dials_, BodyMeasure::Calf, BodyMeasure::Ankle,
                       (static_cast<double>(row) - kCalfRow) / (kAnkleRow - kCalfRow));
    }
  }
  [[nodiscard]] LegRing legRing(std::size_t row) const {
    const LegRing& f = kFemaleLeg[row - 1];
    const LegRing& m = kMaleLeg[row - 1];
    LegRing ring{level(f.z), blend(f.inner, m.inner), blend(f.outer, m.outer),
                 blend(f.front, m.front), blend(f.back, m.back)};
    // High up the inner side stays, so that the legs never meet; the calf grows about its middle.
    // There the outer side goes on the line of the hip, and the dial turns the depth.
    const double keep = std::clamp((static_cast<double>(row) - 1) / 4, 0.0, 1.0);
    const double own = std::log(legScale(row)), hip = dials_[at(BodyMeasure::Hip)];
    const double likeHip = std::pow(1 - keep, 1.5);
    const double likeHipWide =
        std::log(1 + 0.7 * blend(105.5, 96.5) * (std::exp(hip) - 1) / (ring.outer - ring.inner));
    const double wide = std::exp(mix(own, likeHipWide, likeHip));
    const double deep = std::exp(mix(own, 1.9 * own - 0.9 * likeHipWide, likeHip));
    const double pivotX = mix(ring.inner, 0.5 * (ring.inner + ring.outer), keep);
    const double pivotY = 0.5 * (ring.front + ring.back);
    ring.inner = pivotX + (ring.inner - pivotX) * wide;
    ring.outer = pivotX + (ring.outer - pivotX) * wide;
    ring.front = pivotY + (ring.front - pivotY) * deep;
    ring.back = pivotY + (ring.back - pivotY) * deep;
    return ring;
  }
  void buildLegs() {
    for (std::size_t row = kThighRow; row <= kAnkleRow; ++row) {
      const LegRing ring = legRing(row);
      const double x = 0.5 * (ring.inner + ring.outer), y = 0.5 * (ring.front + ring.back);
      for (std::size_t spoke = 0; spoke < kLegSpokes; ++spoke) {
        // Counter-clockwise from above: inner front first, outer side at spoke 5.
        const double t = kPi / 6 * (static_cast<double>(spoke) - kLegOuter);
        const double n = 2 / 2.15;
        const double c = spoke == kLegFront || spoke == kLegBack ? 0 : std::cos(t);
        const double s = spoke == kLegOuter || spoke == kLegInner ? 0 : std::sin(t);
        set(controlNet().leg(Side::Left, row, spoke),
            {x + 0.5 * (ring.outer - ring.inner) * powSigned(c, n),
             y + 0.5 * (ring.back - ring.front) * powSigned(s, n), ring.z});
      }
    }
  }
  void buildFeet() {
    const ControlNet& net = controlNet();
    const LegRing ankle = legRing(kAnkleRow);
    const double x = 0.5 * (ankle.inner + ankle.outer), y = 0.5 * (ankle.front + ankle.back);
    const double size = factor(BodyMeasure::FootLength),
                 wide = std::exp(0.7 * dials_[at(BodyMeasure::FootLength)] +
                                 0.3 * dials_[at(BodyMeasure::Ankle)]);
    const auto place = [&](double across, double ahead, double up) {
      return Vector3d(x + across * wide * std::cos(kToesOut) - ahead * size * std::sin(kToesOut),
                      y + ahead * size * std::cos(kToesOut) + across * wide * std::sin(kToesOut),
                      up);
    };
    for (std::size_t row = kAnkleRow + 1; row <= kToeRow; ++row) {
      const FootRing& ring = kFoot[row - kAnkleRow - 1];
      // From the ankle's width to the foot's own over three rings.
      const double own = std::min(1.0, static_cast<double>(row - kAnkleRow) / 3);
      const double ankleHalf = 0.5 * (ankle.outer - ankle.inner) / wide;
      // Across and, from 0 at the sole to 1 on top, up; the widest place lies low.
      const auto section = [&](double t) {
        constexpr double n = 2 / 2.3;
        const double c = powSigned(std::cos(t), n), s = powSigned(std::sin(t), n);
        const double up = std::clamp(0.42 + 0.5 * c + 0.08 * std::abs(c), 0.0, 1.0);
        return Eigen::Vector2d(s * mix(ankleHalf, s > 0 ? ring.outer : ring.inner, own), up);
      };
      const double tall = std::hypot(ring.topY - ring.bottomY, ring.topZ - ring.bottomZ);
      const std::vector<double> turns = evenParameters(
          [&](double t) {
            const Eigen::Vector2d here = section(t);
            return Eigen::Vector2d(here.x(), tall * here.y());
          },
          kLegSpokes);
      for (std::size_t spoke = 0; spoke < kLegSpokes; ++spoke) {
        const std::size_t turn = (spoke + kLegSpokes - kLegFront) % kLegSpokes;
        const Eigen::Vector2d here = section(turns[turn]);
        set(net.leg(Side::Left, row, spoke), place(here.x(), mix(ring.bottomY, ring.topY, here.y()),
                                                   mix(ring.bottomZ, ring.topZ, here.y())));
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double across = 11.0 * (static_cast<double>(i) - 1);
      set(net.toeTip(Side::Left, i), place(across, kToeTipY + 1.5 * std::abs(across) / 10, 6));
    }
  }

  void mirror() {
    const std::vector<NetVertex>& partner = controlNet().partner();
    // Left limbs and columns were set; those of the right half are their images.
    for (std::size_t v = 0; v < partner.size(); ++v) {
      const auto from = static_cast<Eigen::Index>(v), to = static_cast<Eigen::Index>(partner[v]);
      if (partner[v] == v) points_(from, 0) = 0;
      if (points_(from, 0) > 0)
        points_.row(to) << -points_(from, 0), points_(from, 1), points_(from, 2);
    }
  }

  Form form_;
  double unit_;
  Dials dials_;
  Points points_;
  std::array<double, 8> from_{}, to_{};
  std::array<TrunkRing, 8> trunk_{};
};

}  // namespace

Points controlPoints(const Form& form, double height, const Dials& dials) {
  return Builder(form, height, dials).build();
}

}  // namespace toile::body
