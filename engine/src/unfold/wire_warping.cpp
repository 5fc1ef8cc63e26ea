// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/wire_warping.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "unfold/check.h"
#include "unfold/interior_fill.h"
#include "unfold/least_strain.h"
#include "unfold/start.h"

namespace toile::unfolding {
namespace {

/// The step that promises less than this comes as near as rounding lets it.
constexpr double kWarpDecrease = 1e-11;
constexpr int kMaxWarpSteps = 200;
constexpr double kExact = 1e-9;
/// How often a point that is no minimum is left by a push.
constexpr int kMaxPushes = 3;
/// mm per mm of mean wire edge.
constexpr double kPush = 0.02;

/// The wires as a problem of their own, without cloth.
struct Wires {
  Problem problem;
  std::vector<std::uint32_t> vertexOfNode;
  std::vector<std::uint32_t> partOfNode;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> holds;  ///< per part
};

Wires wiresOf(const Problem& whole, WireWeights weights) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  Wires wires;
  std::vector<std::uint32_t> nodeOf(whole.vertexCount, kNone);
  for (const WireEdge& edge : whole.wireEdges) nodeOf[edge.a] = nodeOf[edge.b] = 0;
  for (std::uint32_t v = 0; v < whole.vertexCount; ++v) {
    if (nodeOf[v] == kNone) continue;
    nodeOf[v] = static_cast<std::uint32_t>(wires.vertexOfNode.size());
    wires.vertexOfNode.push_back(v);
  }
  Problem& problem = wires.problem;
  problem.vertexCount = wires.vertexOfNode.size();
  problem.area = whole.area;
  problem.meanWireEdge = whole.meanWireEdge;
  problem.wireEdges = whole.wireEdges;
  for (WireEdge& edge : problem.wireEdges) {
    edge.a = nodeOf[edge.a];
    edge.b = nodeOf[edge.b];
  }
  problem.corners = whole.corners;
  for (Corner& corner : problem.corners) {
    corner.before = nodeOf[corner.before];
    corner.at = nodeOf[corner.at];
    corner.after = nodeOf[corner.after];
    // J = sum (theta - alpha)^2 * (mean / span).
    corner.span = weights == WireWeights::Unit ? 1 : corner.span / whole.meanWireEdge;
  }

  std::vector<std::uint32_t> root(problem.vertexCount);
  std::iota(root.begin(), root.end(), 0U);
  const auto rootOf = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const WireEdge& edge : problem.wireEdges) {
    const std::uint32_t a = rootOf(edge.a), b = rootOf(edge.b);
    root[std::max(a, b)] = std::min(a, b);
  }
  std::map<std::uint32_t, std::uint32_t> parts;
  for (std::uint32_t v = 0; v < problem.vertexCount; ++v) {
    const auto [part, isNew] =
        parts.try_emplace(rootOf(v), static_cast<std::uint32_t>(parts.size()));
    if (isNew) wires.holds.emplace_back(v, v);
    wires.partOfNode.push_back(part->second);
    wires.holds[part->second].second = v;
  }
  return wires;
}

Plane placesOf(const Wires& wires, const Plane& whole) {
  Plane q(2 * static_cast<Eigen::Index>(wires.vertexOfNode.size()));
  for (std::size_t i = 0; i < wires.vertexOfNode.size(); ++i) {
    q.segment<2>(2 * static_cast<Eigen::Index>(i)) = at(whole, wires.vertexOfNode[i]);
  }
  return q;
}

/// Shifts that depend on nothing but the number of the node.
Plane pushed(const Plane& q, double amount, std::uint32_t seed) {
  Plane moved = q;
  std::uint32_t random = seed;
  for (double& x : moved) {
    random = random * 1664525U + 1013904223U;
    x += amount * (static_cast<double>(random >> 8U) / (1U << 23U) - 1);
  }
  return moved;
}

struct Warped {
  NewtonState state;
  double j = 0;
  std::size_t crossings = 0;
  bool exact = false;
  bool finished = false;
  bool stable = false;
};

class Warper {
 public:
  explicit Warper(const Wires& wires)
      : wires_(wires),
        pattern_(couplingsOf(wires.problem)),
        factor_(pattern_),
        lengths_(wires.problem, pattern_),
        scale_(wires.problem.meanWireEdge * wires.problem.meanWireEdge) {}

  /// @param theta of the corners at q.
  Result<Warped> warp(const Plane& q, std::vector<double> theta, Progress* progress) {
    WireBending bending(wires_.problem, pattern_, std::move(theta));
    // So that the matrix has numbers of about 1 and the lengths' penalty stands out of it.
    bending.setStiffness(scale_);
    bending.useSecondDerivatives();
    ConstrainedNewton newton({&bending}, lengths_, pattern_, factor_, wires_.holds, 1e-3 * scale_);
    Warped warped;
    warped.state.q = q;
    warped.state.lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lengths_.count()));
    for (std::uint32_t push = 0;; ++push) {
      const NewtonEnd end = newton.minimise(
          warped.state, {.maxSteps = kMaxWarpSteps, .lengths = 1e-6, .decrease = kWarpDecrease},
          progress);
      if (end == NewtonEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
      warped.finished = end == NewtonEnd::Converged;
      warped.exact =
          lengths_.worst(lengths_.residual(warped.state.q, warped.state.ratios)) < 1e-3 &&
          newton.project(warped.state) <= kExact;
      warped.stable = warped.exact && newton.isStableAt(warped.state);
      if (!warped.finished || warped.stable || push == kMaxPushes) break;
      // A saddle, as symmetric data gives it: there is a lower place beside it.
      warped.state.q = pushed(warped.state.q, kPush * wires_.problem.meanWireEdge, push + 1);
      bending.moveTo(warped.state.q);
    }
    warped.j = bending.energy(warped.state.q) / scale_;
    warped.crossings = findCrossings(wires_.problem, warped.state.q).size();
    return warped;
  }
  [[nodiscard]] const WireLengths& lengths() const { return lengths_; }

 private:
  const Wires& wires_;
  BlockPattern pattern_;
  SparseFactor factor_;
  WireLengths lengths_;
  double scale_;
};

bool isBetter(const Warped& a, const Warped& b) {
  if (a.exact != b.exact) return a.exact;
  if (a.finished != b.finished) return a.finished;
  if ((a.crossings == 0) != (b.crossings == 0)) return a.crossings == 0;
  return a.j < b.j * (1 - 1e-9);
}

/// The wires where they were wanted, each part moved as a whole to fit the plane.
Plane fitted(const Wires& wires, const Plane& wanted, const Plane& plane) {
  const std::size_t parts = wires.holds.size();
  std::vector<Eigen::Vector2d> from(parts, Eigen::Vector2d::Zero()), to = from;
  std::vector<double> count(parts, 0), dot(parts, 0), cross(parts, 0);
  const auto node = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
  for (std::size_t i = 0; i < wires.vertexOfNode.size(); ++i) {
    const std::uint32_t part = wires.partOfNode[i];
    from[part] += at(wanted, node(i));
    to[part] += at(plane, wires.vertexOfNode[i]);
    count[part] += 1;
  }
  for (std::size_t p = 0; p < parts; ++p) {
    from[p] /= count[p];
    to[p] /= count[p];
  }
  for (std::size_t i = 0; i < wires.vertexOfNode.size(); ++i) {
    const std::uint32_t part = wires.partOfNode[i];
    const Eigen::Vector2d a = at(wanted, node(i)) - from[part];
    const Eigen::Vector2d b = at(plane, wires.vertexOfNode[i]) - to[part];
    dot[part] += a.dot(b);
    cross[part] += a.x() * b.y() - a.y() * b.x();
  }
  Plane moved = wanted;
  for (std::size_t i = 0; i < wires.vertexOfNode.size(); ++i) {
    const std::uint32_t part = wires.partOfNode[i];
    const double size = std::hypot(dot[part], cross[part]);
    const double c = size > 0 ? dot[part] / size : 1, s = size > 0 ? cross[part] / size : 0;
    const Eigen::Vector2d a = at(wanted, node(i)) - from[part];
    moved.segment<2>(2 * static_cast<Eigen::Index>(i)) =
        to[part] + Eigen::Vector2d(c * a.x() - s * a.y(), s * a.x() + c * a.y());
  }
  return moved;
}

}  // namespace

Result<Solution> warpWires(const Piece& piece, const Problem& problem, const UnfoldOptions& options,
                           Progress* progress) {
  const std::vector<Eigen::Vector3d>& positions = piece.mesh->positions();
  const BlockPattern pattern = couplingsOf(problem);
  SparseFactor factor(pattern);
  const auto hold = farBoundaryPair(problem, positions);

  // Starts without folds, so that the corners' angles can be read off the triangles.
  std::vector<Plane> starts;
  int steps = 0;
  LeastStrain leastStrain(problem, options);
  Result<Solution> strained = leastStrain.solve(piece, progress);
  if (strained) {
    steps = strained->state.steps;
    starts.push_back(std::move(strained->state.q));
  } else if (strained.error().code != ErrorCode::LengthsInfeasible) {
    return strained.error();
  }
  std::optional<Plane> conformal = conformalStart(problem, positions, hold, pattern, factor);
  if (conformal && flippedCount(problem, *conformal) == 0) starts.push_back(*std::move(conformal));
  if (std::optional<Plane> circle = circleStart(problem);
      circle && flippedCount(problem, *circle) == 0) {
    starts.push_back(*std::move(circle));
  }

  const Wires wires = wiresOf(problem, options.weights);
  Warper warper(wires);
  std::optional<Warped> best;
  for (const Plane& start : starts) {
    Result<Warped> warped =
        warper.warp(placesOf(wires, start), cornerAngles(problem, start), progress);
    if (!warped) return warped.error();
    steps += warped->state.steps;
    if (!best || isBetter(*warped, *best)) best = *std::move(warped);
  }
  if (!best || !best->exact) {
    WireLengths lengths(problem, pattern);
    NewtonState state;
    state.q = starts.front();
    if (best) {
      for (std::size_t i = 0; i < wires.vertexOfNode.size(); ++i) {
        state.q.segment<2>(2 * Eigen::Index{wires.vertexOfNode[i]}) =
            at(best->state.q, static_cast<std::uint32_t>(i));
      }
    }
    return infeasible(piece, problem, state, lengths);
  }

  Solution solution;
  solution.state.q = starts.front();
  InteriorFill fill(problem, pattern, factor, options);
  for (int round = 0; round < InteriorFill::kRounds; ++round) {
    const Plane wanted = fitted(wires, best->state.q, solution.state.q);
    const bool last = round + 1 == InteriorFill::kRounds;
    if (const Result<void> done =
            fill.pullTo(solution.state.q, wires.vertexOfNode, wanted, round, progress);
        !done) {
      return done.error();
    }
    if (!last) continue;
    for (std::size_t i = 0; i < wires.vertexOfNode.size(); ++i) {
      solution.state.q.segment<2>(2 * Eigen::Index{wires.vertexOfNode[i]}) =
          at(wanted, static_cast<std::uint32_t>(i));
    }
  }
  solution.state.steps = steps;
  solution.finished = best->finished;
  solution.stable = best->stable;
  solution.wireBending = best->j;
  solution.meanEnergy = fill.meanEnergy(solution.state.q);
  return solution;
}

}  // namespace toile::unfolding
