// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/unfold/unfold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "unfold/check.h"
#include "unfold/constrained_newton.h"
#include "unfold/start.h"
#include "unfold/strain_energy.h"
#include "unfold/wire_bending.h"

namespace toile {
namespace {

using namespace unfolding;

/// Wires wave when their compression passes this share of the buckling load (measured: smooth up to
/// 1.06 at the least favourable piece).
constexpr double kBucklingLimit = 1.05;
constexpr int kMaxStiffenings = 6;
/// Waves longer than this share of the piece's size are its shape, not crinkles.
constexpr double kMaxRaisedStiffness = 0.2;
/// How often the stiffness is doubled to part wires that cross; most crossings are the surface's
/// own overlap, which no stiffness cures.
constexpr int kMaxPartings = 2;
/// Mean energy per area from which a piece should not be cut in one.
constexpr double kHighStrain = 0.3;
/// Length errors (relative) that the last projection can take away, and that it must leave.
constexpr double kNearEnoughToProject = 1e-3;
constexpr double kExact = 1e-9;
constexpr std::size_t kMaxNamed = 24;

Result<void> checkOptions(const UnfoldOptions& options) {
  const auto refuse = [](const char* name, double value, const char* range) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{} is {}; it must lie in {}", name, value, range),
                 {}};
  };
  if (!(options.areaWeight >= 0 && options.areaWeight <= 1000)) {
    return refuse("the area weight", options.areaWeight, "0..1000");
  }
  if (!(options.wireStiffness >= 0 && options.wireStiffness <= 10)) {
    return refuse("the wire stiffness", options.wireStiffness, "0..10");
  }
  if (options.maxSteps < 1) return refuse("the number of steps", options.maxSteps, "1 and more");
  return {};
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> couplings(const Problem& problem) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(3 * problem.triangles.size() + problem.corners.size());
  for (const RestTriangle& t : problem.triangles) {
    for (std::size_t k = 0; k < 3; ++k) pairs.emplace_back(t.vertex[k], t.vertex[(k + 1) % 3]);
  }
  for (const Corner& c : problem.corners) pairs.emplace_back(c.before, c.after);
  return pairs;
}

/// The wires with the greatest length errors: curves first, then the edges themselves.
std::vector<Element> worstWires(const Piece& piece, const Problem& problem,
                                const Eigen::VectorXd& residual) {
  std::vector<std::uint32_t> order(problem.wireEdges.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto error = [&](std::uint32_t i) {
    return std::abs(residual[i]) / std::max(problem.wireEdges[i].target, 1.0);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return error(a) > error(b); });
  std::vector<Element> where;
  const double limit = 0.1 * error(order.front());
  const auto addOnce = [&](Element element) {
    if (where.size() < kMaxNamed && std::find(where.begin(), where.end(), element) == where.end()) {
      where.push_back(std::move(element));
    }
  };
  for (const std::uint32_t i : order) {
    if (error(i) < limit) break;
    const std::uint32_t wire = problem.wireEdges[i].wire;
    if (wire != WireEdge::kNoWire) addOnce(Element::curve(piece.wires[wire].curve));
  }
  for (const std::uint32_t i : order) {
    if (error(i) < limit) break;
    addOnce(Element::edge(
        piece.mesh->findEdge(VertexId(problem.wireEdges[i].a), VertexId(problem.wireEdges[i].b))));
  }
  return where;
}

Error infeasible(const Piece& piece, const Problem& problem, const Plane& q,
                 const WireLengths& lengths) {
  const Eigen::VectorXd residual = lengths.residual(q);
  std::vector<Element> where = worstWires(piece, problem, residual);
  const std::string first =
      !where.empty() && where.front().kind == Element::Kind::Curve ? where.front().name : "border";
  return {ErrorCode::LengthsInfeasible,
          fmt::format("the lengths of the wires contradict each other: {:.2g} % is left, the worst "
                      "at \"{}\"; release a feature there, make it elastic or split the piece",
                      100 * lengths.worst(residual), first),
          std::move(where)};
}

/// The compression at which a bar of the wires' stiffness waves in the cloth beside it
/// (docs/unfolding.md).
double bucklingLoad(double areaWeight, double waveLength) {
  const double h = 2 * (areaWeight + 1) / (areaWeight + 2);
  return 6 * std::cbrt(h * h) * waveLength;
}

/// An inner wire has cloth and stiffness on both sides and bears twice as much.
double highestCompression(const Problem& problem, const Eigen::VectorXd& lambda) {
  double highest = 0;
  for (std::size_t i = 0; i < problem.wireEdges.size(); ++i) {
    const double compression = -lambda[static_cast<Eigen::Index>(i)];
    highest = std::max(highest, problem.wireEdges[i].inner ? compression / 2 : compression);
  }
  return highest;
}

struct Solution {
  NewtonState state;
  double wireStiffness = 0;
  double buckling = 0;
  bool finished = true;
  bool stable = true;
  double meanEnergy = 0;  ///< per area, of the strain alone
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings;
};

/// Finds the plane; raises the stiffness of the wires while they would wave or cross.
Result<Solution> solve(const Piece& piece, const Problem& problem, const UnfoldOptions& options,
                       Progress* progress) {
  const std::vector<Eigen::Vector3d>& positions = piece.mesh->positions();
  const BlockPattern pattern(problem.vertexCount, couplings(problem));
  SparseFactor factor(pattern);
  const auto hold = farBoundaryPair(problem, positions);

  std::optional<Plane> start = conformalStart(problem, positions, hold, pattern, factor);
  if (!start || flippedCount(problem, *start) > 0) start = circleStart(problem);
  if (!start || flippedCount(problem, *start) > 0) {
    return Error{ErrorCode::NotConverged,
                 "no first placement without folded faces was found; repair very thin faces or "
                 "split the piece",
                 {}};
  }

  StrainEnergy strain(problem, pattern, options.areaWeight);
  WireBending bending(problem, pattern, *start);
  WireLengths lengths(problem, pattern);
  ConstrainedNewton newton({&strain, &bending}, lengths, pattern, factor, hold, problem.area);

  Solution solution;
  solution.state.q = std::move(*start);
  solution.state.lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lengths.count()));
  solution.wireStiffness = options.wireStiffness;
  const double highest = std::max(kMaxRaisedStiffness, options.wireStiffness);
  std::optional<Solution> crossed;  // the first one, to come back to when parting does not help
  int partings = 0;
  for (int round = 0;; ++round) {
    const double waveLength = solution.wireStiffness * std::sqrt(problem.area);
    bending.setStiffness(waveLength * waveLength * waveLength);
    const NewtonEnd end = newton.minimise(solution.state, options.maxSteps, progress);
    if (end == NewtonEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
    solution.finished = end == NewtonEnd::Converged;
    const bool failed = end == NewtonEnd::Stalled ||
                        lengths.worst(lengths.residual(solution.state.q)) > kNearEnoughToProject ||
                        newton.project(solution.state) > kExact;
    if (failed && !crossed) return infeasible(piece, problem, solution.state.q, lengths);
    solution.crossings = findCrossings(problem, solution.state.q);
    if (crossed && (failed || (!solution.crossings.empty() && partings == kMaxPartings))) {
      crossed->state.steps = solution.state.steps;
      solution = *std::move(crossed);
      bending.moveTo(solution.state.q);
      break;
    }
    const double load = bucklingLoad(options.areaWeight, waveLength);
    solution.buckling = load > 0 ? highestCompression(problem, solution.state.lambda) / load : 0;
    if (round == kMaxStiffenings || !solution.finished || solution.wireStiffness == 0) break;
    if (!solution.crossings.empty()) {
      if (!crossed) crossed = solution;
      ++partings;
      solution.wireStiffness *= 2;
    } else if (!crossed && solution.buckling > kBucklingLimit && solution.wireStiffness < highest) {
      solution.wireStiffness = std::min(highest, solution.wireStiffness * solution.buckling);
    } else {
      break;
    }
  }
  solution.meanEnergy = strain.energy(solution.state.q) / problem.area;
  solution.stable = newton.isStableAt(solution.state);
  return solution;
}

std::vector<Finding> makeFindings(const Piece& piece, const Problem& problem,
                                  const UnfoldOptions& options, const Solution& solution,
                                  const FlatPiece& flat) {
  std::vector<Finding> findings;
  const auto curveOf = [&](std::uint32_t wireEdge) {
    const std::uint32_t wire = problem.wireEdges[wireEdge].wire;
    return wire == WireEdge::kNoWire ? std::string("border") : piece.wires[wire].curve;
  };
  if (flat.check.crossings > 0) {
    Finding finding{"crossings",
                    fmt::format("{} pairs of wire edges cross in the plane: the piece overlaps "
                                "itself and has to be cut into two",
                                flat.check.crossings),
                    {}};
    for (const auto& [a, b] : solution.crossings) {
      for (const std::uint32_t i : {a, b}) {
        Element element = Element::curve(curveOf(i));
        if (finding.where.size() < kMaxNamed &&
            std::find(finding.where.begin(), finding.where.end(), element) == finding.where.end()) {
          finding.where.push_back(std::move(element));
        }
      }
    }
    findings.push_back(std::move(finding));
  }
  if (solution.meanEnergy > kHighStrain) {
    Finding finding{"high-strain",
                    fmt::format("the surface is too curved to be cut in one: {:.1f} % mean and "
                                "{:.0f} % greatest area error; add a dart or another seam",
                                100 * flat.meanAreaError, 100 * flat.maxAreaError),
                    {}};
    std::vector<std::uint32_t> order(problem.triangles.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto error = [&](std::uint32_t i) {
      return std::abs(flat.distortion[FaceId(i)].areaRatio() - 1);
    };
    const std::size_t named = std::min<std::size_t>(8, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(named),
                      order.end(), [&](std::uint32_t a, std::uint32_t b) {
                        return error(a) != error(b) ? error(a) > error(b) : a < b;
                      });
    for (std::size_t i = 0; i < named; ++i) {
      finding.where.push_back(Element::face(FaceId(order[i])));
    }
    findings.push_back(std::move(finding));
  }
  if (solution.wireStiffness > options.wireStiffness) {
    findings.push_back({"wires-stiffened",
                        fmt::format("wires would have waved; their stiffness was raised from "
                                    "{:.3g} to {:.3g}",
                                    options.wireStiffness, solution.wireStiffness),
                        {}});
  }
  if (!solution.stable || solution.buckling > kBucklingLimit) {
    findings.push_back({"wires-may-wave",
                        "some wires are too long for the cloth they enclose and stand under high "
                        "compression; a dart or an elastic line would relieve them",
                        {}});
  }
  if (!solution.finished) {
    findings.push_back({"step-limit",
                        fmt::format("stopped after {} steps: all lengths are right, the strain may "
                                    "not be the least",
                                    solution.state.steps),
                        {}});
  }
  return findings;
}

}  // namespace

Result<FlatPiece> unfold(const Piece& piece, const UnfoldOptions& options, Progress* progress) try {
  if (Result<void> valid = checkOptions(options); !valid) return valid.error();
  Result<Problem> problem = makeProblem(piece);
  if (!problem) return problem.error();
  Result<Solution> solved = solve(piece, *problem, options, progress);
  if (!solved) return solved.error();
  Solution& solution = *solved;

  Plane& q = solution.state.q;
  place(*problem, piece.mesh->positions(), q);
  solution.crossings = findCrossings(*problem, q);
  FlatPiece flat;
  flat.position = VertexData<Eigen::Vector2d>(problem->vertexCount, Eigen::Vector2d::Zero());
  for (std::uint32_t v = 0; v < problem->vertexCount; ++v) flat.position[VertexId(v)] = at(q, v);
  flat.distortion = computeDistortion(*problem, q);
  flat.check = makeCheck(*problem, q, findFlips(*problem, q).size(), solution.crossings.size());
  flat.steps = solution.state.steps;
  flat.wireStiffness = solution.wireStiffness;
  for (std::size_t i = 0; i < problem->triangles.size(); ++i) {
    const double error = std::abs(flat.distortion[FaceId(i)].areaRatio() - 1);
    flat.meanAreaError += error * problem->triangles[i].area / problem->area;
    flat.maxAreaError = std::max(flat.maxAreaError, error);
  }
  flat.findings = makeFindings(piece, *problem, options, solution, flat);
  return flat;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::NotConverged,
               "there is not enough memory to unfold a piece of this size; use a coarser mesh",
               {}};
}

}  // namespace toile
