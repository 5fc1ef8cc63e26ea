// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/fit_dials.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace toile::body {
namespace {

constexpr std::size_t kCount = kBodyMeasureCount;
using Vector = Eigen::Matrix<double, static_cast<int>(kCount), 1>;
using Square = Eigen::Matrix<double, static_cast<int>(kCount), static_cast<int>(kCount)>;

constexpr double kLargestTurn = 0.25;  ///< of a dial in one step
constexpr double kProbe = 1e-4;        ///< of a dial, for differences
constexpr int kMaxSteps = 30;
constexpr double kSlow = 0.2;  ///< a step that leaves more of the error asks for a new Jacobian

Points cageOf(const Form& form, double height, const Vector& turned) {
  Dials dials{};
  for (std::size_t i = 0; i < kCount; ++i) dials[i] = turned[static_cast<Eigen::Index>(i)];
  return subdivision().cageThrough(controlPoints(form, height, dials));
}

/// Logs of measured over wanted.
Vector misses(const Measures& measured, const Measures& wanted) {
  Vector out;
  for (std::size_t i = 0; i < kCount; ++i) {
    out[static_cast<Eigen::Index>(i)] = std::log(measured[i] / wanted[i]);
  }
  return out;
}

bool isMet(const Measures& measured, const Measures& wanted) {
  for (std::size_t i = 0; i < kCount; ++i) {
    if (!(std::abs(measured[i] - wanted[i]) <= kMetMm)) return false;
  }
  return true;
}

}  // namespace

Measures standardMeasures(const Form& form, double height) {
  return tape().measureCage(cageOf(form, height, Vector::Zero()));
}

std::optional<Points> fitDials(const Form& form, const Measures& wanted) {
  const double height = wanted[static_cast<std::size_t>(BodyMeasure::Height)];
  Vector dials = Vector::Zero();
  Points cage = cageOf(form, height, dials);
  Measures measured = tape().measureCage(cage);
  Vector miss = misses(measured, wanted);
  Eigen::PartialPivLU<Square> jacobian;
  bool isStale = true;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (isMet(measured, wanted)) return cage;
    if (isStale) {
      Square differences;
      for (Eigen::Index i = 0; i < differences.cols(); ++i) {
        Vector probe = dials;
        probe[i] += kProbe;
        const Measures there = tape().measureCage(cageOf(form, height, probe));
        differences.col(i) = (misses(there, wanted) - miss) / kProbe;
      }
      jacobian.compute(differences);
    }
    Vector turn = -jacobian.solve(miss);
    if (!turn.allFinite()) return std::nullopt;
    const double largest = turn.cwiseAbs().maxCoeff();
    if (largest > kLargestTurn) turn *= kLargestTurn / largest;
    dials += turn;
    cage = cageOf(form, height, dials);
    measured = tape().measureCage(cage);
    const Vector next = misses(measured, wanted);
    isStale = next.norm() > kSlow * miss.norm();
    miss = next;
  }
  return std::nullopt;
}

}  // namespace toile::body
