// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/keep_apart.h"

#include <set>

#include "unfold/check.h"
#include "unfold/contact_barrier.h"
#include "unfold/least_strain.h"
#include "unfold/start.h"
#include "unfold/symmetry.h"

namespace toile::unfolding {
namespace {

/// Pairs are in the matrix from this many times the distance at which they meet, so that one
/// pattern serves several steps.
constexpr double kWider = 4;
constexpr int kMaxStiffenings = 12;
constexpr double kMaxStiffening = 2;
constexpr double kExact = 1e-9;
/// What lies on itself needs more steps than options allow for an ordinary piece.
constexpr int kMoreSteps = 2;

/// A convex start folds nothing and has a simple boundary.
std::optional<Plane> convexStart(const Problem& problem, const PieceSymmetry* symmetry) {
  std::optional<Plane> q = circleStart(problem);
  if (q && symmetry != nullptr) makeSymmetric(*symmetry, *q);
  if (!q || flippedCount(problem, *q) > 0) return std::nullopt;
  return q;
}

/// All that depends on which vertices are coupled.
class Coupled {
 public:
  Coupled(const Problem& problem, const UnfoldOptions& options, const PieceSymmetry* symmetry,
          ContactBarrier& barrier, const std::vector<Contact>& contacts,
          std::pair<std::uint32_t, std::uint32_t> hold, const WireStiffness& stiffness,
          const Plane& q)
      : pattern_(couplingsOf(
            problem, symmetry != nullptr ? tiesOf(*symmetry, problem.vertexCount) : MirrorTies{},
            couplingsOf(contacts))),
        factor_(pattern_),
        strain_(makeStrain(problem, pattern_, options)),
        bending_(problem, pattern_, cornerAngles(problem, q)),
        lengths_(problem, pattern_),
        newton_({strain_.get(), &bending_, &barrier}, lengths_, pattern_, factor_, {hold},
                problem.area) {
    bending_.setStiffness(stiffness.ofCorners());
    barrier.usePattern(pattern_, contacts);
    for (const auto& pair : couplingsOf(contacts)) coupled_.insert(pair);
  }
  [[nodiscard]] bool covers(const std::vector<Contact>& contacts) const {
    const auto pairs = couplingsOf(contacts);
    return std::all_of(pairs.begin(), pairs.end(),
                       [&](const auto& pair) { return coupled_.contains(pair); });
  }
  [[nodiscard]] ConstrainedNewton& newton() { return newton_; }
  [[nodiscard]] WireLengths& lengths() { return lengths_; }
  [[nodiscard]] WireBending& bending() { return bending_; }
  [[nodiscard]] const TriangleEnergy& strain() const { return *strain_; }

 private:
  BlockPattern pattern_;
  SparseFactor factor_;
  std::unique_ptr<TriangleEnergy> strain_;
  WireBending bending_;
  WireLengths lengths_;
  ConstrainedNewton newton_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> coupled_;
};

}  // namespace

Result<Solution> keepApart(const Problem& problem, const UnfoldOptions& options,
                           const PieceSymmetry* symmetry, const Piece& piece, Progress* progress) {
  const Error none{ErrorCode::NotConverged, "no plane was found that covers nothing twice", {}};
  std::optional<Plane> start = convexStart(problem, symmetry);
  if (!start) return none;
  ContactBarrier barrier(problem);
  WireStiffness stiffness(problem, options);
  const auto hold = farBoundaryPair(problem, piece.mesh->positions());
  std::unique_ptr<Coupled> coupled;
  Solution solution;
  NewtonState& state = solution.state;
  state.q = *std::move(start);
  state.lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.wireEdges.size()));
  state.ratios = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.elastics.size()));
  const auto couple = [&]() -> bool {
    const auto meeting = barrier.contactsAt(state.q, 1);
    if (!meeting) return false;
    if (!coupled || !coupled->covers(*meeting)) {
      coupled =
          std::make_unique<Coupled>(problem, options, symmetry, barrier,
                                    *barrier.contactsAt(state.q, kWider), hold, stiffness, state.q);
    }
    return true;
  };
  int stiffenings = 0;
  const auto stiffen = [&](const NewtonState& reached) {
    if (stiffenings == kMaxStiffenings || !stiffness.raise(reached.lambda, kMaxStiffening)) {
      return false;
    }
    ++stiffenings;
    coupled->bending().setStiffness(stiffness.ofCorners());
    return true;
  };
  // Step by step: other edges may meet after each.
  NewtonEnd end = NewtonEnd::StepLimit;
  while (end == NewtonEnd::StepLimit && state.steps < kMoreSteps * options.maxSteps) {
    if (!couple()) return none;
    end = coupled->newton().minimise(state, {.maxSteps = state.steps + 1, .adjust = stiffen},
                                     progress);
  }
  if (end == NewtonEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
  if (end == NewtonEnd::Stalled || !couple()) return none;
  solution.finished = end == NewtonEnd::Converged;
  if (!(coupled->newton().project(state) < kExact)) return none;
  solution.crossings = findCrossings(problem, state.q);
  if (!solution.crossings.empty() || flippedCount(problem, state.q) > 0 || !couple()) return none;
  solution.buckling = stiffness.buckling(state.lambda);
  solution.wireStiffness = stiffness.greatest();
  solution.stiffened = stiffness.raised();
  solution.meanEnergy = coupled->strain().energy(state.q) / problem.area;
  solution.stable = coupled->newton().isStableAt(state);
  if (!problem.elastics.empty()) solution.elastic = coupled->newton().elasticModelAt(state);
  return solution;
}

}  // namespace toile::unfolding
