// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/posture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>

#include "toile/core/assert.h"

namespace toile::body {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// Shares per vertex of the refined net; those of the left half count.
struct Shares {
  Eigen::VectorXd bothHips, oneHip, knee, shoulder;
};

/// Smooth between the control vertices, within 0..1.
Eigen::VectorXd refined(const Eigen::VectorXd& control) {
  Points column = Points::Zero(control.size(), 3);
  column.col(0) = control;
  const Points out = subdivision().weights() * subdivision().cageThrough(column);
  return out.col(0).cwiseMax(0.0).cwiseMin(1.0);
}

/// Of both hips at once the middle goes along; of one it stays where it is.
Eigen::VectorXd hipShares(bool both) {
  const ControlNet& net = controlNet();
  Eigen::VectorXd control = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(net.vertexCount()));
  const auto set = [&](NetVertex v, double share) {
    control[static_cast<Eigen::Index>(v)] = share;
  };
  const auto aside = [&](std::size_t column) {
    const std::size_t fromMiddle = std::min(column, kBackColumn - column);
    if (fromMiddle > 1) return 1.0;
    return fromMiddle == 1 ? (both ? 0.85 : 0.65) : (both ? 0.6 : 0.0);
  };
  for (std::size_t column = 0; column <= kBackColumn; ++column) {
    set(net.torso(kHighHipRow, column), 0.04 * aside(column));
    set(net.torso(kHipRow, column), 0.22 * aside(column));
    set(net.torso(kSplitRow, column), 0.5 * aside(column));
  }
  for (std::size_t spoke = 0; spoke < kLegSpokes; ++spoke) {
    const bool isInner = spoke == 0 || spoke >= kLegInner - 1;
    set(net.leg(Side::Left, 1, spoke), isInner ? (both ? 0.68 : 0.6) : 0.78);
    set(net.leg(Side::Left, 2, spoke), isInner ? 0.94 : 0.97);
    for (std::size_t row = 3; row <= kToeRow; ++row) set(net.leg(Side::Left, row, spoke), 1);
  }
  for (std::size_t i = 0; i < kToeTips; ++i) set(net.toeTip(Side::Left, i), 1);
  if (both) set(net.crotch(), 0.4);
  return refined(control);
}

Eigen::VectorXd kneeShares() {
  const ControlNet& net = controlNet();
  Eigen::VectorXd control = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(net.vertexCount()));
  static constexpr std::array<double, 5> kAround{0.05, 0.27, 0.52, 0.77, 0.95};  // rows 3 to 7
  for (std::size_t row = kMidThighRow; row <= kToeRow; ++row) {
    const double share = row < kMidThighRow + kAround.size() ? kAround[row - kMidThighRow] : 1;
    for (std::size_t spoke = 0; spoke < kLegSpokes; ++spoke) {
      control[static_cast<Eigen::Index>(net.leg(Side::Left, row, spoke))] = share;
    }
  }
  for (std::size_t i = 0; i < kToeTips; ++i) {
    control[static_cast<Eigen::Index>(net.toeTip(Side::Left, i))] = 1;
  }
  return refined(control);
}

Eigen::VectorXd shoulderShares() {
  const ControlNet& net = controlNet();
  Eigen::VectorXd control = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(net.vertexCount()));
  const auto set = [&](NetVertex v, double share) {
    control[static_cast<Eigen::Index>(v)] = share;
  };
  const auto both = [&](std::size_t row, std::size_t fromSide, double share) {
    set(net.torso(row, kSideColumn - fromSide), share);
    set(net.torso(row, kSideColumn + fromSide), share);
  };
  both(kMidShoulderRow, 0, 0.14);
  both(kMidShoulderRow, 1, 0.12);
  both(kMidShoulderRow, 2, 0.06);
  both(kShoulderRow, 2, 0.2);
  both(kHighChestRow, 2, 0.2);
  both(kLowChestRow, 2, 0.18);
  both(kArmpitRow, 2, 0.14);
  both(kShoulderRow, 3, 0.05);
  both(kHighChestRow, 3, 0.05);
  both(kLowChestRow, 3, 0.05);
  both(kArmpitRow, 3, 0.03);
  both(kBustRow, 0, 0.13);
  both(kBustRow, 1, 0.11);
  both(kBustRow, 2, 0.05);
  both(kUnderbustRow, 0, 0.03);
  static constexpr std::array<double, 4> kRows{0.4, 0.66, 0.88, 0.99};
  for (std::size_t row = 0; row <= kFingerRow; ++row) {
    const double share = row < kRows.size() ? kRows[row] : 1;
    for (std::size_t spoke = 0; spoke < kArmSpokes; ++spoke) {
      set(net.arm(Side::Left, row, spoke), share);
    }
  }
  return refined(control);
}

const Shares& shares() {
  static const Shares all{hipShares(true), hipShares(false), kneeShares(), shoulderShares()};
  return all;
}

template <typename At>
Vector3d middle(const std::vector<Vector3d>& places, std::size_t count, const At& at) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += places[at(i)];
  return sum / static_cast<double>(count);
}

struct Bend {
  const Eigen::VectorXd* share;
  Vector3d joint;
  Vector3d axis;
  double angle;
};

/// The bends of the left side, outer joints first.
std::vector<Bend> bends(const std::vector<Vector3d>& places, Posture posture) {
  const ControlNet& net = controlNet();
  const auto ofLeg = [&](std::size_t row) {
    return [row, &net](std::size_t i) { return net.leg(Side::Left, row, i); };
  };
  const Vector3d knee = middle(places, kLegSpokes, ofLeg(kKneeRow));
  const Vector3d thigh = middle(places, kLegSpokes, ofLeg(kThighRow));
  const Vector3d hip(thigh.x(), thigh.y(),
                     0.5 * (places[net.torso(kHipRow, kSideColumn)].z() +
                            places[net.torso(kSplitRow, kSideColumn)].z()));
  const Vector3d shoulder =
      middle(places, kArmSpokes, [&](std::size_t i) { return net.arm(Side::Left, 0, i); });
  const Vector3d backwards = Vector3d::UnitX(), upwards = -Vector3d::UnitY();
  switch (posture) {
    case Posture::APose:
      return {};
    case Posture::ArmsRaised:
      return {{&shares().shoulder, shoulder, upwards, 85 * kDegree}};
    case Posture::KneeBent:
      return {{&shares().knee, knee, backwards, 70 * kDegree},
              {&shares().oneHip, hip, -backwards, 50 * kDegree}};
    case Posture::Seated: {
      // A belly leaves the thighs less room to rise.
      const double height = places[net.crown(kCrownAcross / 2, kCrownAlong / 2)].z();
      const double belly = hip.y() - places[net.torso(kAbdomenRow, 0)].y();
      const double rise = (82 - 40 * std::clamp(belly / height / 0.045 - 1.6, 0.0, 1.0)) * kDegree;
      return {{&shares().knee, knee, backwards, rise}, {&shares().bothHips, hip, -backwards, rise}};
    }
  }
  return {};
}

}  // namespace

std::vector<Vector3d> inPosture(std::vector<Vector3d> places, Posture posture) {
  const std::vector<Bend> all = bends(places, posture);
  if (all.empty()) return places;
  const std::vector<std::size_t>& partner = subdivision().partner();
  for (std::size_t v = 0; v < places.size(); ++v) {
    const bool isMiddle = partner[v] == v;
    if (places[v].x() < 0) continue;
    Vector3d place = places[v];
    for (const Bend& bend : all) {
      // Only turns about the x axis move the middle, and they keep it in its plane.
      const bool isStill = isMiddle && bend.axis.x() == 0;
      const double share = isStill ? 0 : (*bend.share)[static_cast<Eigen::Index>(v)];
      if (share == 0) continue;
      place = bend.joint + Eigen::AngleAxisd(share * bend.angle, bend.axis) * (place - bend.joint);
    }
    places[v] = place;
    if (!isMiddle && posture != Posture::KneeBent) {
      places[partner[v]] = {-place.x(), place.y(), place.z()};
    }
  }
  double floor = places.front().z();
  for (const Vector3d& place : places) floor = std::min(floor, place.z());
  for (Vector3d& place : places) place.z() -= floor;
  return places;
}

}  // namespace toile::body
