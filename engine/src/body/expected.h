// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <map>

#include "body/tape.h"

namespace toile::body {

/// How bodies vary: the log of each measure about that of the standard body of the same form and
/// height is a Gaussian with a few common causes (stoutness, hips, muscle, bones) and a part of its
/// own. What is not given is expected at the mean that the given ones leave.
///
/// @param standard of the form at the given height
class Expectation {
 public:
  /// @param given mm; measures of a body
  Expectation(const Measures& standard, const std::map<BodyMeasure, double>& given);

  /// The given value, or the mean, mm.
  [[nodiscard]] double value(BodyMeasure measure) const;
  /// Standard deviation of its log that the given ones leave.
  [[nodiscard]] double deviation(BodyMeasure measure) const;

 private:
  [[nodiscard]] Eigen::VectorXd covariances(BodyMeasure measure) const;

  Measures standard_;
  std::map<BodyMeasure, double> given_;
  Eigen::LLT<Eigen::MatrixXd> among_;  ///< of the given ones
  Eigen::VectorXd weights_;
};

}  // namespace toile::body
