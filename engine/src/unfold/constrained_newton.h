// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>

#include "toile/core/progress.h"
#include "unfold/energy_term.h"
#include "unfold/sparse_factor.h"
#include "unfold/wire_lengths.h"

namespace toile::unfolding {

/// Where a run stands, and all it needs to go on.
struct NewtonState {
  Plane q;
  Eigen::VectorXd lambda;  ///< multiplier per wire edge: > 0 tension, < 0 compression
  Eigen::VectorXd ratios;  ///< of the elastic lines
  int steps = 0;           ///< in all
};

/// When to stop.
struct NewtonLimits {
  int maxSteps = 100;      ///< in all, over calls with one state
  double lengths = 1e-4;   ///< greatest length error, relative
  double decrease = 1e-4;  ///< of the merit function that the next step promises, relative
  /// Called after a step near the minimum; may change the terms, and says whether it did.
  std::function<bool(const NewtonState&)> adjust = {};
};

/// What other ratios of the elastic lines would change, to second order.
struct ElasticModel {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd stiffness;
};

enum class NewtonEnd { Converged, Stalled, StepLimit, Cancelled };

/// Minimises a sum of energy terms subject to the exact lengths of the wires.
///
/// Sequential quadratic programming that starts anywhere without flips. The matrix factored is
/// H + penalty J^T J, which is positive definite exactly if H is so along the constraints, has the
/// pattern of the mesh, and solves the full KKT system by one to three repeated solves. The ratios
/// of elastic lines are few: the step is linear in them, so that they are found from a small
/// quadratic function in the box of their ranges, one more solve for each.
/// @see Nocedal and Wright, "Numerical Optimization", 2nd ed., 2006, chapters 17 and 18;
///   docs/unfolding.md.
class ConstrainedNewton {
 public:
  /// @param holds two vertices that fix place and direction of the plane; a pair for each part
  ///   that can move by itself. With ties the first of a pair holds the height, the rest is held.
  ConstrainedNewton(std::vector<EnergyTerm*> terms, WireLengths& lengths,
                    const BlockPattern& pattern, SparseFactor& factor,
                    std::vector<std::pair<std::uint32_t, std::uint32_t>> holds, double areaScale);

  [[nodiscard]] NewtonEnd minimise(NewtonState& state, const NewtonLimits& limits,
                                   const Progress* progress);
  /// Whether the last factorisation of minimise() was of the full Hessian.
  [[nodiscard]] bool lastStepWasConvex() const { return lastStepWasConvex_; }
  /// Moves q the least so that the lengths are right to rounding.
  /// @return greatest error left, relative to max(target, 1 mm).
  [[nodiscard]] double project(NewtonState& state);
  /// A little of the same with the last factor, for previews.
  void projectRoughly(NewtonState& state);
  /// Whether the last point is a minimum with the wires' compression fully counted; false means
  /// that some wire would like to wave.
  [[nodiscard]] bool isStableAt(const NewtonState& state);
  /// At a minimum.
  [[nodiscard]] ElasticModel elasticModelAt(const NewtonState& state);

 private:
  [[nodiscard]] double energy(const Plane& q) const;
  void assemble(const NewtonState& state, double indefinite);
  /// Of the matrix last assembled, which was at this state.
  [[nodiscard]] bool factor(const NewtonState& state);
  [[nodiscard]] bool assembleAndFactor(const NewtonState& state, double indefinite);
  void solveTied(const Eigen::VectorXd& right, Eigen::VectorXd& x);
  /// @param pull the gradient, and J^T lambda.
  void solveStep(const Eigen::VectorXd& pull, const Eigen::VectorXd& residual,
                 Eigen::VectorXd& lambda, Plane& d);
  /// How step and multipliers of solveStep() change with the ratios, in columns.
  struct RatioSteps {
    Eigen::MatrixXd q, lambda;
    ElasticModel model;
  };
  [[nodiscard]] RatioSteps ratioSteps(const Eigen::VectorXd& lambda, const Eigen::VectorXd& ratios);
  struct Step {
    Plane d;
    Eigen::VectorXd lambda, ratios;  ///< the new multipliers; the change of the ratios
    double slope = 0;                ///< of the energy along it
  };
  [[nodiscard]] bool newtonStep(const NewtonState& state, const Eigen::VectorXd& c,
                                double& indefinite, Step& step);
  [[nodiscard]] bool chordStep(const NewtonState& state, const Eigen::VectorXd& c,
                               double slopeBefore, Step& step);
  [[nodiscard]] Plane leastCorrection(const Eigen::VectorXd& residual, int solves);

  std::vector<EnergyTerm*> terms_;
  WireLengths* lengths_;
  SparseFactor* factor_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> holds_;
  double areaScale_;
  bool lastStepWasConvex_ = false;
  BlockMatrix matrix_;
  Eigen::VectorXd gradient_;
  Plane factoredAt_;
  double stepResidual_ = 1e-9;  ///< how exactly solveStep() solves
};

}  // namespace toile::unfolding
