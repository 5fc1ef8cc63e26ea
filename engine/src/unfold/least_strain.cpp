// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/least_strain.h"

#include <algorithm>
#include <cmath>

#include "unfold/check.h"
#include "unfold/keep_apart.h"
#include "unfold/start.h"
#include "unfold/symmetry.h"

namespace toile::unfolding {
namespace {

constexpr int kMaxStiffenings = 12;
/// How much stiffer a wire is made at once: forces on the way may be higher than at the end.
constexpr double kMaxStiffening = 2;
/// How often the stiffness is doubled to part wires that cross; most crossings are the surface's
/// own overlap, which no stiffness cures.
constexpr int kMaxPartings = 2;
/// Length errors (relative) that the last projection can take away, and that it must leave.
constexpr double kNearEnoughToProject = 1e-3;
constexpr double kExact = 1e-9;
/// One step brings lengths to a thousandth and the strain to where the eye sees no difference.
constexpr int kPreviewSteps = 1;

}  // namespace

BlockPattern couplingsOf(const Problem& problem, MirrorTies ties,
                         const std::vector<std::pair<std::uint32_t, std::uint32_t>>& more) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs = more;
  pairs.reserve(more.size() + 3 * problem.triangles.size() + problem.corners.size() +
                problem.wireEdges.size());
  for (const RestTriangle& t : problem.triangles) {
    for (std::size_t k = 0; k < 3; ++k) pairs.emplace_back(t.vertex[k], t.vertex[(k + 1) % 3]);
  }
  for (const Corner& c : problem.corners) pairs.emplace_back(c.before, c.after);
  for (const WireEdge& edge : problem.wireEdges) pairs.emplace_back(edge.a, edge.b);
  return ties.empty() ? BlockPattern(problem.vertexCount, pairs)
                      : BlockPattern(std::move(ties), pairs);
}

Result<Plane> unfoldedStart(const Problem& problem, const std::vector<Eigen::Vector3d>& positions,
                            std::pair<std::uint32_t, std::uint32_t> hold,
                            const BlockPattern& pattern, SparseFactor& factor) {
  std::optional<Plane> start = boundaryFirstStart(problem, pattern, factor.elimination());
  if (!start || flippedCount(problem, *start) > 0) {
    start = conformalStart(problem, positions, hold, pattern, factor);
  }
  if (!start || flippedCount(problem, *start) > 0) start = circleStart(problem);
  if (!start || flippedCount(problem, *start) > 0) {
    return Error{ErrorCode::NotConverged,
                 "no first placement without folded faces was found; repair very thin faces or "
                 "split the piece",
                 {}};
  }
  return *std::move(start);
}

LeastStrain::LeastStrain(const Problem& problem, const UnfoldOptions& options,
                         const PieceSymmetry* symmetry)
    : problem_(&problem),
      options_(options),
      symmetry_(symmetry),
      pattern_(couplingsOf(
          problem, symmetry != nullptr ? tiesOf(*symmetry, problem.vertexCount) : MirrorTies{})),
      factor_(pattern_),
      strain_(makeStrain(problem, pattern_, options)),
      lengths_(problem, pattern_),
      stiffness_(problem, options) {}

Result<void> LeastStrain::start(const Piece& piece) {
  const std::vector<Eigen::Vector3d>& positions = piece.mesh->positions();
  const auto hold = farBoundaryPair(*problem_, positions);
  Result<Plane> q = symmetry_ != nullptr
                        ? symmetricStart(*problem_, positions, *symmetry_, pattern_, factor_)
                        : unfoldedStart(*problem_, positions, hold, pattern_, factor_);
  if (!q) return q.error();
  bending_.emplace(*problem_, pattern_, cornerAngles(*problem_, *q));
  newton_.emplace(std::vector<EnergyTerm*>{strain_.get(), &*bending_}, lengths_, pattern_, factor_,
                  std::vector{hold}, problem_->area);
  solution_ = {};
  solution_.state.q = *std::move(q);
  solution_.state.lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lengths_.count()));
  solution_.state.ratios =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lengths_.elasticCount()));
  stiffness_.reset();
  bending_->setStiffness(stiffness_.ofCorners());
  return {};
}

/// Finds the plane; raises the stiffness of the wires while they would wave or cross.
Result<Solution> LeastStrain::solve(const Piece& piece, Progress* progress) {
  if (Result<void> started = start(piece); !started) return started.error();
  Solution& solution = solution_;
  std::optional<Solution> crossed;  // the first one, to come back to when parting does not help
  int partings = 0, stiffenings = 0;
  const auto stiffen = [&](const NewtonState& state) {
    if (stiffenings == kMaxStiffenings || !stiffness_.raise(state.lambda, kMaxStiffening)) {
      return false;
    }
    ++stiffenings;
    bending_->setStiffness(stiffness_.ofCorners());
    return true;
  };
  for (;;) {
    const NewtonEnd end = newton_->minimise(
        solution.state, {.maxSteps = options_.maxSteps, .adjust = stiffen}, progress);
    if (end == NewtonEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
    solution.finished = end == NewtonEnd::Converged;
    solution.stable = solution.finished && newton_->lastStepWasConvex();
    const bool failed = end == NewtonEnd::Stalled ||
                        lengths_.worst(lengths_.residual(solution.state.q, solution.state.ratios)) >
                            kNearEnoughToProject ||
                        newton_->project(solution.state) > kExact;
    if (failed && !crossed) return infeasible(piece, *problem_, solution.state, lengths_);
    solution.crossings = findCrossings(*problem_, solution.state.q);
    if (crossed && (failed || (!solution.crossings.empty() && partings == kMaxPartings))) {
      crossed->state.steps = solution.state.steps;
      solution = *std::move(crossed);
      bending_->moveTo(solution.state.q);
      break;
    }
    solution.buckling = stiffness_.buckling(solution.state.lambda);
    solution.wireStiffness = stiffness_.greatest();
    solution.stiffened = stiffness_.raised();
    if (solution.crossings.empty() || !solution.finished || solution.wireStiffness == 0) break;
    if (!crossed) crossed = solution;
    ++partings;
    stiffness_.doubleAll();
    bending_->setStiffness(stiffness_.ofCorners());
  }
  if (!solution.crossings.empty() && options_.keepApart) {
    Result<Solution> apart = keepApart(*problem_, options_, symmetry_, piece, progress);
    if (apart) {
      apart->overlapping = std::move(solution.state.q);
      apart->state.steps += solution.state.steps;
      return apart;
    }
    if (apart.error().code == ErrorCode::Cancelled) return apart;
  }
  solution.meanEnergy = strain_->energy(solution.state.q) / problem_->area;
  if (!solution.stable) solution.stable = newton_->isStableAt(solution.state);
  if (lengths_.elasticCount() > 0) solution.elastic = newton_->elasticModelAt(solution.state);
  return solution;
}

Result<Solution> LeastStrain::preview(const Piece& piece, Progress* progress) {
  if (!newton_) {
    if (Result<void> started = start(piece); !started) return started.error();
  }
  solution_.state.steps = 0;
  const NewtonEnd end = newton_->minimise(solution_.state, {.maxSteps = kPreviewSteps}, progress);
  if (end == NewtonEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
  newton_->projectRoughly(solution_.state);
  if (stiffness_.raise(solution_.state.lambda, kMaxStiffening)) {
    bending_->setStiffness(stiffness_.ofCorners());
  }
  solution_.wireStiffness = stiffness_.greatest();
  return solution_;
}

}  // namespace toile::unfolding
