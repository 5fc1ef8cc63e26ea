// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/expected.h"

#include <algorithm>
#include <cmath>

namespace toile::body {
namespace {

struct Variation {
  double stout, hips, muscle, bone, limbs;  ///< standard deviation of the log by each cause
  double own;                               ///< what no common cause explains
};

// Made by hand from what is known of such surveys: girths of soft parts vary by a tenth or more and
// together, those over bone by a few hundredths, lengths by themselves.
Variation variation(BodyMeasure measure) {
  switch (measure) {
    case BodyMeasure::Height:
      return {0, 0, 0, 0, 0, 0.04};
    case BodyMeasure::Head:
      return {0.004, 0, 0, 0.015, 0, 0.02};
    case BodyMeasure::Neck:
      return {0.05, 0, 0.03, 0.015, 0, 0.025};
    case BodyMeasure::NeckBase:
      return {0.04, 0, 0.02, 0.02, 0, 0.02};
    case BodyMeasure::ShoulderLength:
      return {0.005, 0, 0.015, 0.03, 0, 0.03};
    case BodyMeasure::Chest:
      return {0.10, 0.01, 0.03, 0.02, 0, 0.03};
    case BodyMeasure::Underbust:
      return {0.10, 0.01, 0.025, 0.02, 0, 0.02};
    case BodyMeasure::Waist:
      return {0.138, 0.015, 0, 0.01, 0, 0.03};
    case BodyMeasure::HighHip:
      return {0.11, 0.04, 0, 0.01, 0, 0.02};
    case BodyMeasure::Hip:
      return {0.08, 0.05, 0, 0.02, 0, 0.02};
    case BodyMeasure::Thigh:
      return {0.09, 0.05, 0.02, 0, 0, 0.025};
    case BodyMeasure::MidThigh:
      return {0.08, 0.04, 0.03, 0, 0, 0.02};
    case BodyMeasure::Knee:
      return {0.055, 0.015, 0.01, 0.02, 0, 0.02};
    case BodyMeasure::Calf:
      return {0.06, 0.01, 0.03, 0.01, 0, 0.025};
    case BodyMeasure::Ankle:
      return {0.035, 0, 0, 0.025, 0, 0.025};
    case BodyMeasure::Armscye:
      return {0.07, 0, 0.03, 0.02, 0, 0.02};
    case BodyMeasure::UpperArm:
      return {0.10, 0, 0.045, 0, 0, 0.025};
    case BodyMeasure::Elbow:
      return {0.06, 0, 0.03, 0.02, 0, 0.02};
    case BodyMeasure::Wrist:
      return {0.035, 0, 0.01, 0.025, 0, 0.02};
    case BodyMeasure::ArmLength:
      return {0, 0, 0, 0, 0.03, 0.015};
    case BodyMeasure::BackLength:
      return {0.01, 0, 0, 0, -0.02, 0.02};
    case BodyMeasure::InsideLeg:
      return {-0.005, 0, 0, 0, 0.03, 0.01};
    case BodyMeasure::FootLength:
      return {0, 0, 0, 0.015, 0.015, 0.02};
  }
  return {};
}

double covariance(BodyMeasure a, BodyMeasure b) {
  const Variation u = variation(a), v = variation(b);
  const double common = u.stout * v.stout + u.hips * v.hips + u.muscle * v.muscle +
                        u.bone * v.bone + u.limbs * v.limbs;
  return common + (a == b ? u.own * u.own : 0);
}

}  // namespace

Expectation::Expectation(const Measures& standard, const std::map<BodyMeasure, double>& given)
    : standard_(standard), given_(given) {
  Eigen::VectorXd departure(static_cast<Eigen::Index>(given.size()));
  Eigen::MatrixXd among(departure.size(), departure.size());
  Eigen::Index row = 0;
  for (const auto& [measure, value] : given) {
    departure[row] = std::log(value / standard[static_cast<std::size_t>(measure)]);
    among.row(row++) = covariances(measure).transpose();
  }
  if (given.empty()) return;
  among_.compute(among);
  weights_ = among_.solve(departure);
}

Eigen::VectorXd Expectation::covariances(BodyMeasure measure) const {
  Eigen::VectorXd out(static_cast<Eigen::Index>(given_.size()));
  Eigen::Index row = 0;
  for (const auto& [other, value] : given_) out[row++] = covariance(measure, other);
  return out;
}

double Expectation::value(BodyMeasure measure) const {
  if (const auto found = given_.find(measure); found != given_.end()) return found->second;
  const double mean = given_.empty() ? 0 : covariances(measure).dot(weights_);
  return standard_[static_cast<std::size_t>(measure)] * std::exp(mean);
}

double Expectation::deviation(BodyMeasure measure) const {
  double variance = covariance(measure, measure);
  if (!given_.empty()) {
    const Eigen::VectorXd with = covariances(measure);
    variance -= with.dot(among_.solve(with));
  }
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace toile::body
