// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/constrained_newton.h"

#include "unfold/box_minimum.h"

#include <algorithm>
#include <cmath>

// Notation: E = sum of the terms, g its gradient, H its (projected) Hessian, c the length errors,
// J their Jacobian, lambda the multipliers, d the step, alpha its length, s the second-order
// correction, nu the weights of |c| in the merit function E + sum nu |c|.
namespace toile::unfolding {
namespace {

/// Weight of J^T J. With 1e4 the KKT system needs half as many solves again, with 1e2 the lengths
/// stay inexact; larger costs digits.
constexpr double kPenalty = 1e6;
/// The full Hessian is in the matrix only where the lengths are nearly right.
constexpr double kNearLengths = 1e-2;
constexpr double kArmijo = 1e-4;
constexpr double kShareOfWayToFlip = 0.8;
constexpr double kStallStep = 1e-4;
constexpr int kStallSteps = 3;
/// What shall be changed near the minimum is changed when a step promises less than this share.
constexpr double kAdjustSlope = 5e-2;
/// What a step may leave of the linearised lengths, relative: always, and as a share of the
/// decrease at which the run ends, since the correction behind it and the last projection take it
/// away.
constexpr double kExactResidual = 1e-9;
constexpr double kStepResidual = 1e-2;
/// Length errors nearer to rounding than this are not worth another solve.
constexpr double kRounding = 1e-13;
/// A factor serves once more when its last step promised less than this share of the energy, and
/// as long as each step promises less than this share of the one before.
constexpr double kChordSlope = 5e-2;
constexpr double kChordGain = 0.1;
constexpr int kMaxHalvings = 40;
constexpr int kMaxProjections = 30;
/// Energy of an elastic line's ratio of 1, as a share of the piece's own: next to nothing, so that
/// a ratio which changes nothing else stays 0.
constexpr double kElasticPrice = 1e-4;

}  // namespace

ConstrainedNewton::ConstrainedNewton(std::vector<EnergyTerm*> terms, WireLengths& lengths,
                                     const BlockPattern& pattern, SparseFactor& factor,
                                     std::vector<std::pair<std::uint32_t, std::uint32_t>> holds,
                                     double areaScale)
    : terms_(std::move(terms)),
      lengths_(&lengths),
      factor_(&factor),
      holds_(std::move(holds)),
      areaScale_(areaScale),
      matrix_(pattern) {}

double ConstrainedNewton::energy(const Plane& q) const {
  double sum = 0;
  for (const EnergyTerm* term : terms_) sum += term->energy(q);
  return sum;
}

/// The lengths are linearised at the same place.
void ConstrainedNewton::assemble(const NewtonState& state, double indefinite) {
  lengths_->linearise(state.q);
  matrix_.setZero();
  gradient_ = Eigen::VectorXd::Zero(state.q.size());
  for (const EnergyTerm* term : terms_)
    term->addDerivatives(state.q, indefinite, gradient_, matrix_);
  lengths_->addCurvature(state.lambda, indefinite, kPenalty, matrix_);
  // Moving and turning cost nothing; springs hold them without changing the solution.
  const bool isTied = !matrix_.pattern().ties().empty();
  if (isTied) matrix_.fillAxis();
  for (const auto& [first, second] : holds_) {
    if (isTied) {
      matrix_.addDiagonal(first, 0, 0, 1);
      continue;
    }
    const Eigen::Vector2d line = (at(state.q, second) - at(state.q, first)).normalized();
    matrix_.addDiagonal(first, 1, 0, 1);
    matrix_.addDiagonal(second, line.y() * line.y(), -line.x() * line.y(), line.x() * line.x());
  }
}

bool ConstrainedNewton::factor(const NewtonState& state) {
  factoredAt_ = state.q;
  return factor_->factor(matrix_);
}

bool ConstrainedNewton::assembleAndFactor(const NewtonState& state, double indefinite) {
  assemble(state, indefinite);
  return factor(state);
}

void ConstrainedNewton::solveTied(const Eigen::VectorXd& right, Eigen::VectorXd& x) {
  const MirrorTies& ties = matrix_.pattern().ties();
  if (ties.empty()) return factor_->solve(right, x);
  factor_->solve(ties.reduce(right), x);
  x = ties.expand(x);
}

// (H + penalty J^T J) d = -(g + J^T (lambda + penalty c)) fulfils H d + g + J^T lambda' = 0 with
// lambda' = lambda + penalty (J d + c) exactly; repeating with the residual r = J d + c as the new
// right side drives J d + c to zero.
void ConstrainedNewton::solveStep(const Eigen::VectorXd& pull, const Eigen::VectorXd& residual,
                                  Eigen::VectorXd& lambda, Plane& d) {
  constexpr int kMaxRepeats = 8;
  Eigen::VectorXd right = pull;
  lengths_->addTransposeTimes(kPenalty * residual, right);
  right = -right;
  solveTied(right, d);
  Plane e;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxRepeats; ++i) {
    const Eigen::VectorXd r = lengths_->jacobianTimes(d) + residual;
    lambda += kPenalty * r;
    const double size = lengths_->worst(r);
    if (size < stepResidual_ || !(size < 0.9 * before)) break;
    before = size;
    right.setZero();
    lengths_->addTransposeTimes(-kPenalty * r, right);
    solveTied(right, e);
    d += e;
  }
}

// The step that changes ratio k alone by 1 fulfils H w + J^T mu = 0, J w = L with the targets L of
// its line. The energy that a step d + W r ends at is quadratic in r: its gradient at r = 0 is -L^T
// lambda', its second derivatives are W^T H W = -L^T mu.
ConstrainedNewton::RatioSteps ConstrainedNewton::ratioSteps(const Eigen::VectorXd& lambda,
                                                            const Eigen::VectorXd& ratios) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(gradient_.size());
  const auto count = static_cast<Eigen::Index>(lengths_->elasticCount());
  RatioSteps steps{Eigen::MatrixXd(gradient_.size(), count),
                   Eigen::MatrixXd(lambda.size(), count),
                   {Eigen::VectorXd(count), Eigen::MatrixXd(count, count)}};
  std::vector<Eigen::VectorXd> targets;
  for (Eigen::Index k = 0; k < count; ++k) {
    targets.push_back(lengths_->targetsOf(static_cast<std::size_t>(k)));
    Eigen::VectorXd change = Eigen::VectorXd::Zero(lambda.size());
    Plane d;
    solveStep(none, -targets.back(), change, d);
    steps.q.col(k) = d;
    steps.lambda.col(k) = change;
  }
  const double price = kElasticPrice * areaScale_;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd& target = targets[static_cast<std::size_t>(k)];
    steps.model.gradient[k] = price * ratios[k] - target.dot(lambda);
    steps.model.stiffness.row(k) = -target.transpose() * steps.lambda;
    steps.model.stiffness(k, k) += price;
  }
  steps.model.stiffness = 0.5 * (steps.model.stiffness + steps.model.stiffness.transpose()).eval();
  return steps;
}

/// The shortest s, measured by the matrix, with J s = -residual.
Plane ConstrainedNewton::leastCorrection(const Eigen::VectorXd& residual, int solves) {
  Plane s;
  Eigen::VectorXd r = residual;
  for (int i = 0; i < solves; ++i) {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(gradient_.size());
    lengths_->addTransposeTimes(-kPenalty * r, right);
    if (i == 0) {
      solveTied(right, s);
    } else {
      Plane e;
      solveTied(right, e);
      s += e;
    }
    r = lengths_->jacobianTimes(s) + residual;
    if (lengths_->worst(r) < 1e-3 * lengths_->worst(residual)) break;
  }
  return s;
}

/// A step from a new factorisation; false if there is none that is definite.
bool ConstrainedNewton::newtonStep(const NewtonState& state, const Eigen::VectorXd& c,
                                   double& indefinite, Step& step) {
  const bool near = lengths_->worst(c) < kNearLengths;
  bool factored = factor(state);
  lastStepWasConvex_ = factored && near && indefinite == 1;
  if (!factored && near) {
    indefinite *= 0.5;
    factored = assembleAndFactor(state, indefinite);
    if (!factored) {
      indefinite *= 0.5;
      factored = assembleAndFactor(state, 0);
    }
  }
  if (!factored) return false;
  step.lambda = state.lambda;
  Eigen::VectorXd pull = gradient_;
  lengths_->addTransposeTimes(state.lambda, pull);
  solveStep(pull, c, step.lambda, step.d);
  step.ratios = Eigen::VectorXd::Zero(state.ratios.size());
  if (state.ratios.size() > 0) {
    const RatioSteps byRatio = ratioSteps(step.lambda, state.ratios);
    const Eigen::VectorXd range = lengths_->ranges();
    step.ratios = minimumInBox(byRatio.model.gradient, byRatio.model.stiffness,
                               -range - state.ratios, range - state.ratios);
    step.d += byRatio.q * step.ratios;
    step.lambda += byRatio.lambda * step.ratios;
  }
  step.slope = gradient_.dot(step.d) + kElasticPrice * areaScale_ * state.ratios.dot(step.ratios);
  return step.d.allFinite();
}

// The matrix hardly changes any more: the new gradient with the old factor, and the old J that
// belongs to it, give nearly the step that a new factor would.
bool ConstrainedNewton::chordStep(const NewtonState& state, const Eigen::VectorXd& c,
                                  double slopeBefore, Step& step) {
  Eigen::VectorXd pull = gradient_;
  lengths_->addTransposeTimes(state.lambda, pull);
  lengths_->linearise(factoredAt_);
  step.lambda = state.lambda;
  solveStep(pull, c, step.lambda, step.d);
  step.ratios = Eigen::VectorXd::Zero(state.ratios.size());
  step.slope = pull.dot(step.d) + state.lambda.dot(c);
  if (step.d.allFinite() && -step.slope < kChordGain * -slopeBefore) return true;
  lengths_->linearise(state.q);
  return false;
}

NewtonEnd ConstrainedNewton::minimise(NewtonState& state, const NewtonLimits& limits,
                                      const Progress* progress) {
  double indefinite = 1;
  int shortSteps = 0;
  Eigen::VectorXd nu = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lengths_->count()));
  Eigen::VectorXd c = lengths_->residual(state.q, state.ratios);
  const Eigen::VectorXd range = lengths_->ranges();
  const auto energyAt = [&](const Plane& q, const Eigen::VectorXd& ratios) {
    return energy(q) + 0.5 * kElasticPrice * areaScale_ * ratios.squaredNorm();
  };
  double e = energyAt(state.q, state.ratios);
  double slopeBefore = 0;  // of the last step, if it was a whole one
  stepResidual_ =
      range.size() > 0 ? kExactResidual : std::max(kExactResidual, kStepResidual * limits.decrease);
  for (; state.steps < limits.maxSteps; ++state.steps) {
    if (isCancelled(progress)) return NewtonEnd::Cancelled;
    assemble(state, lengths_->worst(c) < kNearLengths ? indefinite : 0);
    Step step;
    const bool mayReuse = -slopeBefore > 0 && -slopeBefore < kChordSlope * e &&
                          lengths_->worst(c) < limits.lengths && range.size() == 0;
    const bool isReused = mayReuse && chordStep(state, c, slopeBefore, step);
    if (!isReused && !newtonStep(state, c, indefinite, step)) return NewtonEnd::Stalled;

    const Eigen::VectorXd wanted = 1.3 * step.lambda.cwiseAbs();
    nu = wanted.cwiseMax(0.5 * (nu + wanted));
    const double merit = e + nu.dot(c.cwiseAbs());
    const double slope = step.slope - nu.dot(c.cwiseAbs());

    double border = std::numeric_limits<double>::infinity();
    for (const EnergyTerm* term : terms_) {
      border = std::min(border, term->distanceToBorder(state.q, step.d));
    }
    double alpha = std::min(1.0, kShareOfWayToFlip * border);
    // What the linearised lengths miss on the way is of second order in alpha.
    const Eigen::VectorXd missed =
        (lengths_->residual(state.q + alpha * step.d, state.ratios + alpha * step.ratios) -
         (1 - alpha) * c) /
        (alpha * alpha);
    const Plane s = leastCorrection(missed, 2);

    const double rounding = 1e-14 * std::abs(merit) + 1e-30 * areaScale_;
    Plane trial;
    Eigen::VectorXd trialC, trialRatios;
    double trialE = 0;
    bool accepted = false;
    for (int halving = 0; halving < kMaxHalvings; ++halving, alpha *= 0.5) {
      trial = state.q + alpha * step.d + alpha * alpha * s;
      // A full step to the end of a range ends there, not a rounding beside it.
      trialRatios = (state.ratios + alpha * step.ratios).cwiseMax(-range).cwiseMin(range);
      trialE = energyAt(trial, trialRatios);
      if (!std::isfinite(trialE)) continue;
      trialC = lengths_->residual(trial, trialRatios);
      if (trialE + nu.dot(trialC.cwiseAbs()) <= merit + kArmijo * alpha * slope + rounding) {
        accepted = true;
        break;
      }
    }
    if (!accepted && isReused) {
      slopeBefore = 0;
      continue;
    }
    if (!accepted) {
      // No way down that doubles can show: arrived if the lengths are right.
      return lengths_->worst(c) < limits.lengths ? NewtonEnd::Converged : NewtonEnd::Stalled;
    }
    state.q = trial;
    state.ratios = trialRatios;
    state.lambda += alpha * (step.lambda - state.lambda);
    c = trialC;
    e = trialE;
    for (EnergyTerm* term : terms_) term->moveTo(state.q);
    indefinite = std::min(1.0, 1.5 * indefinite + 0.1);
    slopeBefore = alpha == 1 ? slope : 0;

    const double error = lengths_->worst(c);
    if (limits.adjust && error < kNearLengths && -slope < kAdjustSlope * e &&
        limits.adjust(state)) {
      e = energyAt(state.q, state.ratios);
      slopeBefore = 0;
      continue;
    }
    if (error < limits.lengths && alpha > 0.5 &&
        -slope < limits.decrease * e + 1e-18 * areaScale_) {
      ++state.steps;
      return NewtonEnd::Converged;
    }
    shortSteps = alpha < kStallStep && error > limits.lengths ? shortSteps + 1 : 0;
    if (shortSteps >= kStallSteps) return NewtonEnd::Stalled;
  }
  return NewtonEnd::StepLimit;
}

double ConstrainedNewton::project(NewtonState& state) {
  Eigen::VectorXd c = lengths_->residual(state.q, state.ratios);
  double error = lengths_->worstForUser(c);
  double factoredAt = error;
  int sinceFactor = 0;
  for (int i = 0; i < kMaxProjections && error > kRounding; ++i) {
    // The factor and the J it was made with belong together: a new J alone diverges.
    const Plane s = leastCorrection(c, 1);
    const Plane trial = state.q + s;
    const Eigen::VectorXd trialC = lengths_->residual(trial, state.ratios);
    const double trialError = lengths_->worstForUser(trialC);
    ++sinceFactor;
    if (trialError < error && std::isfinite(energy(trial))) {
      const bool slow = trialError > 0.7 * error;
      state.q = trial;
      c = trialC;
      error = trialError;
      if (!slow) continue;
    }
    if (error < 1e-12 || (sinceFactor <= 1 && !(error < factoredAt))) break;
    if (!assembleAndFactor(state, 0)) break;
    factoredAt = error;
    sinceFactor = 0;
  }
  for (EnergyTerm* term : terms_) term->moveTo(state.q);
  return error;
}

void ConstrainedNewton::projectRoughly(NewtonState& state) {
  constexpr int kRounds = 2;
  constexpr double kEnough = 1e-5;
  for (int i = 0; i < kRounds; ++i) {
    const Eigen::VectorXd c = lengths_->residual(state.q, state.ratios);
    if (lengths_->worst(c) < kEnough) break;
    const Plane trial = state.q + leastCorrection(c, 1);
    if (!std::isfinite(energy(trial))) break;
    state.q = trial;
  }
  for (EnergyTerm* term : terms_) term->moveTo(state.q);
}

ElasticModel ConstrainedNewton::elasticModelAt(const NewtonState& state) {
  if (!assembleAndFactor(state, 1) && !assembleAndFactor(state, 0)) return {};
  stepResidual_ = kExactResidual;
  Eigen::VectorXd lambda = state.lambda;
  Eigen::VectorXd pull = gradient_;
  lengths_->addTransposeTimes(lambda, pull);
  Plane d;
  solveStep(pull, lengths_->residual(state.q, state.ratios), lambda, d);
  return ratioSteps(lambda, state.ratios).model;
}

bool ConstrainedNewton::isStableAt(const NewtonState& state) {
  return assembleAndFactor(state, 1);
}

}  // namespace toile::unfolding
