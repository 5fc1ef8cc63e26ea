// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/expected.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace toile::body {
namespace {

struct Variation {
  double stout, hips, muscle, bone, limbs;  ///< standard deviation of the log by each cause
  double own;                               ///< what no common cause explains
  double freedom;                           ///< greatest factor about the expected value
};

// Made by hand from what is known of such surveys: girths of soft parts vary by a tenth or more and
// together, those over bone by a few hundredths, lengths by themselves.
Variation variation(BodyMeasure measure) {
  switch (measure) {
    case BodyMeasure::Height:
      return {0, 0, 0, 0, 0, 0.04, 1};
    case BodyMeasure::Head:
      return {0.004, 0, 0, 0.015, 0, 0.02, 1.10};
    case BodyMeasure::Neck:
      return {0.05, 0, 0.03, 0.015, 0, 0.025, 1.16};
    case BodyMeasure::NeckBase:
      return {0.04, 0, 0.02, 0.02, 0, 0.02, 1.14};
    case BodyMeasure::ShoulderLength:
      return {0.005, 0, 0.015, 0.03, 0, 0.03, 1.18};
    case BodyMeasure::Chest:
      return {0.10, 0.01, 0.03, 0.02, 0, 0.03, 1.32};
    case BodyMeasure::Underbust:
      return {0.10, 0.01, 0.025, 0.02, 0, 0.02, 1.14};
    case BodyMeasure::Waist:
      return {0.13, 0.015, 0, 0.01, 0, 0.03, 1.32};
    case BodyMeasure::HighHip:
      return {0.11, 0.04, 0, 0.01, 0, 0.02, 1.16};
    case BodyMeasure::Hip:
      return {0.08, 0.05, 0, 0.02, 0, 0.02, 1.28};
    case BodyMeasure::Thigh:
      return {0.09, 0.05, 0.02, 0, 0, 0.025, 1.16};
    case BodyMeasure::MidThigh:
      return {0.08, 0.04, 0.03, 0, 0, 0.02, 1.14};
    case BodyMeasure::Knee:
      return {0.055, 0.015, 0.01, 0.02, 0, 0.02, 1.16};
    case BodyMeasure::Calf:
      return {0.06, 0.01, 0.03, 0.01, 0, 0.025, 1.18};
    case BodyMeasure::Ankle:
      return {0.035, 0, 0, 0.025, 0, 0.025, 1.16};
    case BodyMeasure::Armscye:
      return {0.07, 0, 0.03, 0.02, 0, 0.02, 1.12};
    case BodyMeasure::UpperArm:
      return {0.10, 0, 0.045, 0, 0, 0.025, 1.16};
    case BodyMeasure::Elbow:
      return {0.06, 0, 0.03, 0.02, 0, 0.02, 1.14};
    case BodyMeasure::Wrist:
      return {0.035, 0, 0.01, 0.025, 0, 0.02, 1.16};
    case BodyMeasure::ArmLength:
      return {0, 0, 0, 0, 0.03, 0.015, 1.12};
    case BodyMeasure::BackLength:
      return {0.01, 0, 0, 0, -0.02, 0.02, 1.08};
    case BodyMeasure::InsideLeg:
      return {-0.005, 0, 0, 0, 0.03, 0.01, 1.07};
    case BodyMeasure::FootLength:
      return {0, 0, 0, 0.015, 0.015, 0.02, 1.14};
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

double freedom(BodyMeasure measure) {
  return variation(measure).freedom;
}

Measures expectedMeasures(const Measures& standard, const std::map<BodyMeasure, double>& given) {
  std::vector<BodyMeasure> known;
  Eigen::VectorXd departure(static_cast<Eigen::Index>(given.size()));
  for (const auto& [measure, value] : given) {
    departure[static_cast<Eigen::Index>(known.size())] =
        std::log(value / standard[static_cast<std::size_t>(measure)]);
    known.push_back(measure);
  }
  const auto count = static_cast<Eigen::Index>(known.size());
  Eigen::MatrixXd among(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      among(i, j) =
          covariance(known[static_cast<std::size_t>(i)], known[static_cast<std::size_t>(j)]);
    }
  }
  Eigen::VectorXd weights(count);
  if (count > 0) weights = among.llt().solve(departure);
  Measures out = standard;
  for (std::size_t m = 0; m < kBodyMeasureCount; ++m) {
    const auto measure = static_cast<BodyMeasure>(m);
    if (const auto found = given.find(measure); found != given.end()) {
      out[m] = found->second;
      continue;
    }
    double mean = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      mean += covariance(measure, known[static_cast<std::size_t>(i)]) * weights[i];
    }
    out[m] = standard[m] * std::exp(mean);
  }
  return out;
}

}  // namespace toile::body
