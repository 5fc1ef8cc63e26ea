// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fitter.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "fit/arms.h"
#include "fit/fine.h"
#include "fit/judge.h"
#include "toile/core/nearest_name.h"

namespace toile::fitting {
namespace {

constexpr std::size_t kNodes = 120;
constexpr std::size_t kFewestPoints = 100;
/// From so many on they place the template.
constexpr std::size_t kEnoughLandmarks = 6;
/// Where arms and hands end is held by so much, in all.
constexpr double kLevelWeight = 0.03;
constexpr std::size_t kMisfitStep = 5;  // every fifth point is asked
/// A draft starts from far away; one that starts from another is near already.
constexpr CoarseSchedule kFromNear = {.first = 2, .end = 6, .rounds = 3};

Places placesOf(const ReferenceModel& model) {
  Places places;
  for (const auto& [name, point] : model.landmarks) places[name] = position(*model.mesh, point);
  return places;
}

/// A unit that was taken for another is seen at once: everything is 10, 25.4 or 1000 times off.
Result<void> checkSize(const Mesh& mesh, const std::string& name, const std::string& scanName,
                       const FitLimits& limits, const Target& target) {
  const double own = (mesh.boxMax() - mesh.boxMin()).norm();
  const double ratio = target.diagonal / own;
  if (!(target.diagonal > 0) || !std::isfinite(ratio)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("the points of {} all lie in one place", scanName),
                 {}};
  }
  constexpr double kLeast = 5;
  constexpr double kMost = 20000;
  if (own < kLeast || own > kMost) {
    return Error{ErrorCode::UnitsMissing,
                 fmt::format("the template {} is {:.4g} mm across: is its unit right? Give --units",
                             name, own),
                 {}};
  }
  // Turned boxes differ in their diagonals, by 1.7 at most.
  constexpr double kTurned = 1.8;
  if (ratio > limits.leastScale / kTurned && ratio < limits.mostScale * kTurned) {
    return {};
  }
  constexpr std::array<FileUnit, 4> kUnits = {FileUnit::Millimetre, FileUnit::Centimetre,
                                              FileUnit::Inch, FileUnit::Metre};
  std::string likely;
  for (const FileUnit read : kUnits) {
    for (const FileUnit meant : kUnits) {
      const double factor = millimetresPer(meant) / millimetresPer(read);
      const double then = ratio * factor;
      if (factor == 1 || then < 0.5 || then > 2) continue;
      if (!likely.empty()) likely += " or ";
      likely += fmt::format("{} taken for {}", toString(meant), toString(read));
    }
  }
  return Error{
      ErrorCode::UnitsMissing,
      fmt::format("{} is {:.4g} mm across, the template {:.4g} mm{}; say the unit of the "
                  "file with --units",
                  scanName, target.diagonal, own,
                  likely.empty() ? "" : ": is it " + likely + ", or another kind of model?"),
      {}};
}

}  // namespace

Result<Target> prepareTarget(const Scan& scan) {
  if (scan.points.size() < kFewestPoints) {
    return Error{
        ErrorCode::InvalidArgument,
        fmt::format("the scan {} has {} points; that is too few", scan.name, scan.points.size()),
        {}};
  }
  return makeTarget(scan);
}

void Fitter::step(std::string_view name) const {
  if (progress_ != nullptr) progress_->step(name);
}

Result<void> Fitter::check(const Target& target) const {
  for (const auto& member : options_.family) {
    if (member->connectivityHash() == mesh_.connectivityHash()) continue;
    return Error{
        ErrorCode::ModelMismatch,
        fmt::format("a member of the family is not on the connectivity of {}", model_.name),
        {}};
  }
  for (const auto& [name, place] : options_.landmarks) {
    if (model_.landmarks.contains(name)) {
      if (place.allFinite()) continue;
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("landmark \"{}\" of the scan is no place", name),
                   {Element::landmark(name)}};
    }
    std::vector<std::string> known;
    for (const auto& [own, point] : model_.landmarks) known.push_back(own);
    return Error{
        ErrorCode::InvalidArgument,
        fmt::format("{} has no landmark \"{}\"{}", model_.name, name, suggestion(name, known)),
        {Element::landmark(name)}};
  }
  return checkSize(mesh_, model_.name, scanName_, options_.limits, target);
}

std::optional<Draft> Fitter::draft(Target& target) const {
  step("fit: placement");
  Draft draft;
  draft.placement = findPlacement(target);
  if (draft.placement.scanIsInsideOut) {
    for (Eigen::Vector3d& n : target.normals) n = -n;
  }
  if (isCancelled(progress_)) return std::nullopt;
  step("fit: coarse");
  CoarseProblem& problem = draft.problem;
  problem.graph = makeGraph(mesh_, mesh_.positions(), kNodes);
  problem.rest = placed(draft.placement.similarity);
  problem.family = familyAround(problem.rest);
  problem.pins = landmarkPins();
  pose(draft.placement, target, problem);
  std::optional<CoarseFit> coarse = fitCoarse(mesh_.triangles(), problem, target, {}, progress_);
  if (!coarse) return std::nullopt;
  draft.coarse = *std::move(coarse);
  return draft;
}

std::optional<Draft> Fitter::draftFrom(const Draft& near, const Target& target) const {
  step("fit: coarse");
  Draft draft;
  draft.placement = near.placement;
  const Shape there = makeShape(mesh_.triangles(), near.coarse.positions);
  draft.placement.similarity = bestSimilarity(mesh_.positions(), there.positions, there.area);
  CoarseProblem& problem = draft.problem;
  problem.graph = near.problem.graph;
  problem.rest = placed(draft.placement.similarity);
  problem.family = familyAround(problem.rest);
  problem.pins = near.problem.pins;
  const std::vector<std::uint32_t> segmentOf = segmentOfPoints(mesh_.positions(), placesOf(model_));
  if (!segmentOf.empty()) {
    std::vector<Similarity> motions;
    for (std::uint32_t s = 0; s < bodySegments().size(); ++s) {
      const std::string& name = bodySegments()[s].name;
      if (!name.ends_with("arm") && !name.ends_with("hand")) {
        motions.emplace_back();
        continue;
      }
      std::vector<double> weights = there.area;
      for (std::size_t v = 0; v < weights.size(); ++v) {
        if (segmentOf[v] != s) weights[v] = 0;
      }
      motions.push_back(bestSimilarity(problem.rest.positions, there.positions, weights));
    }
    take(poseBySegments(mesh_, problem.rest.positions, segmentOf, motions), problem);
  }
  std::optional<CoarseFit> coarse =
      fitCoarse(mesh_.triangles(), problem, target, kFromNear, progress_);
  if (!coarse) return std::nullopt;
  draft.coarse = *std::move(coarse);
  return draft;
}

Misfit Fitter::misfit(const Draft& draft, const Target& target) const {
  const Shape shape = makeShape(mesh_.triangles(), draft.coarse.positions);
  const double diagonal =
      (mesh_.boxMax() - mesh_.boxMin()).norm() * draft.placement.similarity.scale;
  const double stray = options_.limits.strayDistance.value() * diagonal;
  // By vertices alone, so with some room for what lies between them.
  const auto farShare = [](const std::vector<Eigen::Vector3d>& points,
                           const std::vector<double>& area, const KdTree& tree, double limit) {
    double all = 0, far = 0;
    for (std::size_t i = 0; i < points.size(); i += kMisfitStep) {
      all += area[i];
      if (tree.nearest(points[i]).squaredDistance > limit * limit) far += area[i];
    }
    return all > 0 ? far / all : 1;
  };
  return {farShare(target.points, target.area, KdTree(shape.positions), stray),
          farShare(shape.positions, shape.area, target.tree, stray)};
}

Result<Fit> Fitter::finish(const Draft& draft, const Target& target) const {
  step("fit: fine");
  std::optional<std::vector<Eigen::Vector3d>> fine =
      fitFine(mesh_, makeShape(mesh_.triangles(), draft.coarse.positions), target, progress_);
  if (!fine) return Error{ErrorCode::Cancelled, "the fit was cancelled", {}};
  const Expectation expected = expect(draft);
  untangle(mesh_, expected, *fine);
  uncross(mesh_, expected, *fine);

  step("fit: report");
  Result<ReferenceModel> named = withMesh(model_, scanName_, mesh_.withPositions(*fine));
  if (!named) return named.error();
  Fit fit;
  fit.model = *std::move(named);
  const Similarity& placed = draft.placement.similarity;
  fit.placement.linear() = placed.scale * placed.rotation;
  fit.placement.translation() = placed.shift;
  const std::vector<std::uint32_t> regions = regionOfPoints(mesh_.positions(), placesOf(model_));
  fit.report = judge({*fit.model.mesh, target, draft.placement, expected, regions, options_.limits,
                      options_.hasMittens});
  fit.report.familySize = options_.family.size();
  std::vector<double> misses;
  for (const auto& [name, place] : options_.landmarks) {
    misses.push_back((position(*fit.model.mesh, model_.landmarks.at(name)) - place).norm());
  }
  fit.report.landmarks = summarise(misses, std::vector<double>(misses.size(), 1.0));
  return fit;
}

Placement Fitter::findPlacement(const Target& target) const {
  const Shape shape = makeShape(mesh_.triangles(), mesh_.positions());
  if (options_.landmarks.size() < kEnoughLandmarks) {
    return place(shape, target, model_.symmetry.has_value());
  }
  std::vector<Eigen::Vector3d> own, wanted;
  for (const auto& [name, place] : options_.landmarks) {
    own.push_back(position(mesh_, model_.landmarks.at(name)));
    wanted.push_back(place);
  }
  return placeByLandmarks(shape, target, own, wanted);
}

Shape Fitter::placed(const Similarity& similarity) const {
  std::vector<Eigen::Vector3d> positions;
  for (const Eigen::Vector3d& p : mesh_.positions()) positions.push_back(similarity.apply(p));
  return makeShape(mesh_.triangles(), std::move(positions));
}

std::vector<std::vector<Eigen::Vector3d>> Fitter::familyAround(const Shape& rest) const {
  std::vector<std::vector<Eigen::Vector3d>> family;
  for (const auto& member : options_.family) {
    const Similarity onto = bestSimilarity(member->positions(), rest.positions, rest.area);
    std::vector<Eigen::Vector3d>& added = family.emplace_back();
    for (std::size_t v = 0; v < rest.positions.size(); ++v) {
      added.push_back(onto.apply(member->positions()[v]) - rest.positions[v]);
    }
  }
  return family;
}

/// Takes the rest shape and what the family adds to it into the posture that landmarks say; without
/// them a body's arms to where the scan has them.
void Fitter::pose(const Placement& placement, const Target& target, CoarseProblem& problem) const {
  Places own;
  for (const auto& [name, p] : placesOf(model_)) own[name] = placement.similarity.apply(p);
  if (options_.landmarks.size() >= kEnoughLandmarks) {
    std::optional<Posed> posed =
        poseByLandmarks(mesh_, problem.rest.positions, own, options_.landmarks);
    if (posed) take(*std::move(posed), problem);
    return;
  }
  const std::vector<std::uint32_t> segmentOf = segmentOfPoints(problem.rest.positions, own);
  const auto arms = findArms(problem.rest, segmentOf, own, placement.similarity.rotation, target);
  if (!arms) return;
  take(poseBySegments(mesh_, problem.rest.positions, segmentOf, arms->motions), problem);
  for (const Arms::Level& level : arms->levels) {
    Pin& pin = problem.pins.emplace_back(pinAt(level.landmark));
    pin.along = level.along;
    pin.weight = kLevelWeight / static_cast<double>(arms->levels.size());
    pin.place.setZero();
    for (std::size_t c = 0; c < 3; ++c) {
      pin.place +=
          pin.weights[static_cast<Eigen::Index>(c)] * problem.rest.positions[pin.vertices[c]];
    }
  }
}

void Fitter::take(Posed posed, CoarseProblem& problem) const {
  problem.rest = makeShape(mesh_.triangles(), std::move(posed.positions));
  for (std::vector<Eigen::Vector3d>& added : problem.family) {
    for (std::size_t v = 0; v < added.size(); ++v) added[v] = posed.linear[v] * added[v];
  }
}

Pin Fitter::pinAt(const std::string& landmark) const {
  const SurfacePoint& point = model_.landmarks.at(landmark);
  const FaceId face = facesOf(mesh_, point).front();
  const Triangle& t = mesh_.vertices(face);
  Pin pin;
  pin.vertices = {t[0].index(), t[1].index(), t[2].index()};
  pin.weights = barycentricIn(mesh_, point, face);
  return pin;
}

std::vector<Pin> Fitter::landmarkPins() const {
  std::vector<Pin> pins;
  const double trust = 1 / (1 + std::pow(options_.landmarkError.mm(), 2));
  for (const auto& [name, place] : options_.landmarks) {
    Pin& pin = pins.emplace_back(pinAt(name));
    pin.place = place;
    pin.weight = trust / static_cast<double>(options_.landmarks.size());
  }
  return pins;
}

/// The rest shape with its share of the family, as the graph turns and stretches it.
Expectation Fitter::expect(const Draft& draft) const {
  const CoarseProblem& problem = draft.problem;
  const CoarseFit& coarse = draft.coarse;
  Expectation expected;
  expected.shape = problem.rest.positions;
  for (std::size_t b = 0; b < problem.family.size(); ++b) {
    for (std::size_t v = 0; v < expected.shape.size(); ++v) {
      expected.shape[v] += coarse.coefficients[b] * problem.family[b][v];
    }
  }
  for (const auto& shares : problem.graph.ofVertex) {
    Eigen::Matrix3d& mean = expected.linear.emplace_back(Eigen::Matrix3d::Zero());
    for (const Graph::Share& share : shares) mean += share.weight * coarse.linear[share.node];
  }
  for (const Triangle& t : mesh_.triangles()) {
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    for (const VertexId v : t) mean += expected.linear[v.index()];
    expected.normals.push_back(nearestRotation(mean) *
                               faceCross(problem.rest.positions, t).stableNormalized());
  }
  return expected;
}

}  // namespace toile::fitting
