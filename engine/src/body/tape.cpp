// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/tape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "body/chains.h"
#include "body/form.h"

namespace toile::body {
namespace {

/// The curve along which a measure is taken; empty for heights and the foot.
std::string chainOf(BodyMeasure measure) {
  switch (measure) {
    case BodyMeasure::Head:
      return "head_girth";
    case BodyMeasure::Neck:
      return "neck_girth";
    case BodyMeasure::NeckBase:
      return "neck_base";
    case BodyMeasure::ShoulderLength:
      return "shoulder_l";
    case BodyMeasure::Chest:
      return "bust_girth";
    case BodyMeasure::Underbust:
      return "underbust_girth";
    case BodyMeasure::Waist:
      return "waist_girth";
    case BodyMeasure::HighHip:
      return "high_hip_girth";
    case BodyMeasure::Hip:
      return "hip_girth";
    case BodyMeasure::Thigh:
      return "thigh_girth_l";
    case BodyMeasure::MidThigh:
      return "midthigh_girth_l";
    case BodyMeasure::Knee:
      return "knee_girth_l";
    case BodyMeasure::Calf:
      return "calf_girth_l";
    case BodyMeasure::Ankle:
      return "ankle_girth_l";
    case BodyMeasure::Armscye:
      return "armhole_l";
    case BodyMeasure::UpperArm:
      return "upperarm_girth_l";
    case BodyMeasure::Elbow:
      return "elbow_girth_l";
    case BodyMeasure::Wrist:
      return "wrist_girth_l";
    case BodyMeasure::ArmLength:
      return "arm_outer_l";
    case BodyMeasure::BackLength:
      return "centre_back";
    case BodyMeasure::Height:
    case BodyMeasure::InsideLeg:
    case BodyMeasure::FootLength:
      return "";
  }
  return "";
}

/// The chain of a measure; of the centre back only the part down to the waist.
std::vector<std::size_t> verticesOf(BodyMeasure measure) {
  const std::string name = chainOf(measure);
  if (name.empty()) return {};
  std::vector<std::size_t> vertices = namedChains().at(name).vertices;
  if (measure == BodyMeasure::BackLength) {
    const auto waist =
        std::find(vertices.begin(), vertices.end(), namedVertices().at("waist_back"));
    vertices.erase(waist + 1, vertices.end());
  }
  return vertices;
}

std::vector<std::size_t> footVertices() {
  std::vector<std::size_t> vertices;
  for (std::size_t i = 0; i < kToeTips; ++i) {
    vertices.push_back(controlNet().toeTip(Side::Left, i));
  }
  for (std::size_t row = kAnkleRow + 1; row <= kToeRow; ++row) {
    for (std::size_t spoke = 0; spoke < kLegSpokes; ++spoke) {
      const auto along = subdivision().alongEdge(controlNet().leg(Side::Left, row, spoke),
                                                 controlNet().leg(Side::Left, row, spoke + 1));
      vertices.insert(vertices.end(), along.begin(), along.end() - 1);
    }
  }
  return vertices;
}

}  // namespace

Tape::Tape() {
  std::set<std::size_t> needed;
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    for (const std::size_t v : verticesOf(info.measure)) needed.insert(v);
  }
  for (const std::size_t v : footVertices()) needed.insert(v);
  needed.insert(namedVertices().at("crown"));
  needed.insert(namedVertices().at("crotch"));
  vertices_.assign(needed.begin(), needed.end());

  std::vector<Eigen::Triplet<double, int>> picked;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    picked.emplace_back(static_cast<int>(i), static_cast<int>(vertices_[i]), 1.0);
  }
  SparseRows pick(static_cast<Eigen::Index>(vertices_.size()), subdivision().weights().rows());
  pick.setFromTriplets(picked.begin(), picked.end());
  weights_ = pick * subdivision().weights();

  for (const BodyMeasureInfo& info : bodyMeasures()) {
    Line line;
    for (const std::size_t v : verticesOf(info.measure)) line.rows.push_back(row(v));
    const std::string chain = chainOf(info.measure);
    line.closed = !chain.empty() && namedChains().at(chain).closed;
    lines_.push_back(std::move(line));
  }
  for (const std::size_t v : footVertices()) foot_.push_back(row(v));
  crown_ = row(namedVertices().at("crown"));
  crotch_ = row(namedVertices().at("crotch"));
}

Eigen::Index Tape::row(std::size_t vertex) const {
  return std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin();
}

double Tape::length(const Line& line, const Points& places) const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.rows.size(); ++i) {
    sum += (places.row(line.rows[i + 1]) - places.row(line.rows[i])).norm();
  }
  if (line.closed) sum += (places.row(line.rows.front()) - places.row(line.rows.back())).norm();
  return sum;
}

Measures Tape::measure(const Points& places) const {
  constexpr double kFar = std::numeric_limits<double>::max();
  double floor = kFar, toe = -kFar, heel = kFar;
  for (const Eigen::Index i : foot_) {
    floor = std::min(floor, places(i, 2));
    const double along = places(i, 0) * std::sin(kToesOut) - places(i, 1) * std::cos(kToesOut);
    toe = std::max(toe, along);
    heel = std::min(heel, along);
  }
  Measures out{};
  for (std::size_t m = 0; m < kBodyMeasureCount; ++m) {
    switch (static_cast<BodyMeasure>(m)) {
      case BodyMeasure::Height:
        out[m] = places(crown_, 2) - floor;
        break;
      case BodyMeasure::InsideLeg:
        out[m] = places(crotch_, 2) - floor;
        break;
      case BodyMeasure::FootLength:
        out[m] = toe - heel;
        break;
      default:
        out[m] = length(lines_[m], places);
    }
  }
  return out;
}

const Tape& tape() {
  static const Tape one;
  return one;
}

}  // namespace toile::body
