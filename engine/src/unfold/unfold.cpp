// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/unfold/unfold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "toile/unfold/symmetrise.h"
#include "unfold/check.h"
#include "unfold/cloth_energy.h"
#include "unfold/least_strain.h"
#include "unfold/overlap.h"
#include "unfold/symmetry.h"
#include "unfold/wire_warping.h"

namespace toile {
namespace {

using namespace unfolding;

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
  if (options.cloth) {
    const ClothWeights& weights = options.cloth->weights;
    for (const double weight : {weights.along, weights.across, weights.shear}) {
      if (!(weight >= 1e-3 && weight <= 1e3)) {
        return refuse("a weight of the cloth", weight, "0.001..1000");
      }
    }
  }
  if (options.maxSteps < 1) return refuse("the number of steps", options.maxSteps, "1 and more");
  return {};
}

Error outOfMemory() {
  return {ErrorCode::NotConverged,
          "there is not enough memory to unfold a piece of this size; use a coarser mesh",
          {}};
}

/// What would overlap elsewhere is told by where its first layer lies now.
void moveToPlane(const Problem& problem, const Plane& q, std::vector<Overlap>& overlaps) {
  for (Overlap& overlap : overlaps) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double area = 0;
    for (const FaceId f : overlap.layers[0]) {
      const RestTriangle& t = problem.triangles[f.index()];
      for (const std::uint32_t v : t.vertex) sum += t.area / 3 * at(q, v);
      area += t.area;
    }
    overlap.middle = sum / area;
  }
}

FlatPiece flatPiece(const Piece& piece, const Problem& problem, const UnfoldOptions& options,
                    bool isSymmetric, ElasticAnswer elastic, Solution solution) {
  Plane& q = solution.state.q;
  place(problem, piece.mesh->positions(), isSymmetric, q);
  solution.crossings = findCrossings(problem, q);
  FlatPiece flat;
  flat.position = VertexData<Eigen::Vector2d>(problem.vertexCount, Eigen::Vector2d::Zero());
  for (std::uint32_t v = 0; v < problem.vertexCount; ++v) flat.position[VertexId(v)] = at(q, v);
  flat.distortion = computeDistortion(problem, q);
  flat.check = makeCheck(problem, q, findFlips(problem, q).size(), solution.crossings.size());
  flat.steps = solution.state.steps;
  flat.wireStiffness = solution.wireStiffness;
  flat.wireBending = solution.wireBending;
  flat.elastic = std::move(elastic);
  for (std::size_t i = 0; i < problem.triangles.size(); ++i) {
    const double error = std::abs(flat.distortion[FaceId(i)].areaRatio() - 1);
    flat.meanAreaError += error * problem.triangles[i].area / problem.area;
    flat.maxAreaError = std::max(flat.maxAreaError, error);
  }
  const bool isKeptApart = solution.overlapping.size() > 0;
  if (isKeptApart || flat.check.crossings > 0) {
    flat.overlaps = findOverlaps(piece, problem, isKeptApart ? solution.overlapping : q);
  }
  if (isKeptApart) moveToPlane(problem, q, flat.overlaps);
  flat.findings = makeFindings(piece, problem, options, solution, flat);
  return flat;
}

/// What was found of the elastic lines; their targets in the problem become what was found.
ElasticAnswer takeElastics(const Solution& solution, Problem& problem) {
  ElasticAnswer answer;
  for (std::size_t i = 0; i < problem.elastics.size(); ++i) {
    answer.lines.push_back({problem.elastics[i].curve, problem.elastics[i].range,
                            solution.state.ratios[static_cast<Eigen::Index>(i)]});
  }
  answer.gradient = solution.elastic.gradient;
  answer.stiffness = solution.elastic.stiffness;
  fixElastics(solution.state.ratios, problem);
  return answer;
}

void layGrain(const Piece& piece, const UnfoldOptions& options, Problem& problem) {
  if (!options.cloth) return;
  problem.grain = grainOf(problem, piece.mesh->positions(), options.cloth->grain);
}

/// Cloth whose threads run slantwise is not its own mirror image.
bool hasSlantedGrain(const UnfoldOptions& options) {
  if (!options.cloth) return false;
  const double quarters = options.cloth->grain.turn.radians() / (0.5 * std::numbers::pi);
  return std::abs(quarters - std::round(quarters)) > 1e-9;
}

bool sameConnectivity(const Problem& a, const Problem& b) {
  const auto sameTriangle = [](const RestTriangle& s, const RestTriangle& t) {
    return s.vertex == t.vertex;
  };
  const auto sameEdge = [](const WireEdge& s, const WireEdge& t) {
    return s.a == t.a && s.b == t.b;
  };
  return a.vertexCount == b.vertexCount &&
         std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(), b.triangles.end(),
                    sameTriangle) &&
         std::equal(a.wireEdges.begin(), a.wireEdges.end(), b.wireEdges.begin(), b.wireEdges.end(),
                    sameEdge);
}

Result<FlatPiece> unfoldOne(const Piece& piece, const PieceSymmetry* symmetry,
                            const UnfoldOptions& options, Progress* progress) try {
  if (Result<void> valid = checkOptions(options); !valid) return valid.error();
  Result<Problem> problem = makeProblem(piece);
  if (!problem) return problem.error();
  layGrain(piece, options, *problem);
  std::optional<PieceSymmetry> found;
  if (hasSlantedGrain(options)) symmetry = nullptr;
  if (!hasSlantedGrain(options) && symmetry == nullptr && options.keepSymmetry &&
      options.objective == UnfoldObjective::LeastStrain) {
    found = findExactSymmetry(piece, *problem);
    if (found) symmetry = &*found;
  }
  const bool isWarped = options.objective == UnfoldObjective::WireWarping;
  ElasticAnswer elastic;
  std::optional<Result<Solution>> solution;
  // How the wires turn says too little of how long they want to be: the cloth's strain says it.
  if (!isWarped || !problem->elastics.empty()) {
    solution = LeastStrain(*problem, options, symmetry).solve(piece, progress);
    if (!*solution) return solution->error();
    elastic = takeElastics(**solution, *problem);
  }
  if (isWarped) solution = warpWires(piece, *problem, options, progress);
  if (!*solution) return solution->error();
  const bool isSymmetric = symmetry != nullptr && !isWarped;
  return flatPiece(piece, *problem, options, isSymmetric, std::move(elastic),
                   **std::move(solution));
} catch (const std::bad_alloc&) {
  return outOfMemory();
}

}  // namespace

Result<FlatPiece> unfold(const Piece& piece, const UnfoldOptions& options, Progress* progress) {
  return unfoldOne(piece, nullptr, options, progress);
}

Result<FlatPiece> unfold(const SymmetricPiece& piece, const UnfoldOptions& options,
                         Progress* progress) {
  return unfoldOne(piece.piece, &piece.symmetry, options, progress);
}

struct UnfoldPreview::State {
  UnfoldOptions options;
  Problem problem;
  std::optional<LeastStrain> solver;
};

UnfoldPreview::UnfoldPreview(const UnfoldOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
}
UnfoldPreview::~UnfoldPreview() = default;

Result<FlatPiece> UnfoldPreview::update(const Piece& piece, Progress* progress) try {
  State& state = *state_;
  if (Result<void> valid = checkOptions(state.options); !valid) return valid.error();
  Result<Problem> problem = makeProblem(piece);
  if (!problem) return problem.error();
  const bool isWarm = state.solver && sameConnectivity(*problem, state.problem);
  state.problem = *std::move(problem);
  layGrain(piece, state.options, state.problem);
  for (const bool warm : {isWarm, false}) {
    if (!warm) state.solver.emplace(state.problem, state.options);
    Result<Solution> solution = state.solver->preview(piece, progress);
    // What the last answer cannot be bent into may still come from a new start.
    if (!solution && warm && solution.error().code != ErrorCode::Cancelled) continue;
    if (!solution) {
      state.solver.reset();
      return solution.error();
    }
    ElasticAnswer elastic = takeElastics(*solution, state.problem);
    return flatPiece(piece, state.problem, state.options, false, std::move(elastic),
                     *std::move(solution));
  }
  return Error{ErrorCode::NotConverged, "no preview", {}};
} catch (const std::bad_alloc&) {
  return outOfMemory();
}

}  // namespace toile
