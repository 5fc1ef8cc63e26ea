// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/fit/fit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "fit/arms.h"
#include "fit/coarse.h"
#include "fit/fine.h"
#include "fit/judge.h"
#include "fit/posture.h"
#include "fit/segments.h"
#include "fit/untangle.h"
#include "toile/core/nearest_name.h"

namespace toile {
namespace {

using namespace fitting;

constexpr std::size_t kNodes = 120;
/// From so many on they place the template.
constexpr std::size_t kEnoughLandmarks = 6;

Error cancelled() {
  return {ErrorCode::Cancelled, "the fit was cancelled", {}};
}

Places placesOf(const ReferenceModel& model) {
  Places places;
  for (const auto& [name, point] : model.landmarks) places[name] = position(*model.mesh, point);
  return places;
}

class Fitter {
 public:
  Fitter(const ReferenceModel& model, const Scan& scan, const FitOptions& options,
         Progress* progress)
      : model_(model), mesh_(*model.mesh), scan_(scan), options_(options), progress_(progress) {}

  Result<Fit> run() {
    if (const Result<void> fine = check(); !fine) return fine.error();
    step("fit: scan");
    Target target = makeTarget(scan_);
    if (const Result<void> fine = checkSize(target); !fine) return fine.error();
    step("fit: placement");
    const Placement placement = findPlacement(target);
    if (placement.scanIsInsideOut) {
      for (Eigen::Vector3d& n : target.normals) n = -n;
    }
    if (isCancelled(progress_)) return cancelled();

    step("fit: coarse");
    const Graph graph = makeGraph(mesh_, mesh_.positions(), kNodes);
    CoarseProblem problem{mesh_.triangles(), graph, target, placed(placement), {}, pins(), 1};
    problem.family = familyAround(problem.rest);
    pose(placement, target, problem);
    problem.pinScale = 1 / (1 + std::pow(options_.landmarkError.mm(), 2));
    const std::optional<CoarseFit> coarse = fitCoarse(problem, progress_);
    if (!coarse) return cancelled();
    step("fit: fine");
    std::optional<std::vector<Eigen::Vector3d>> fine =
        fitFine(mesh_, makeShape(mesh_.triangles(), coarse->positions), target, progress_);
    if (!fine) return cancelled();
    const Expectation expected = expect(problem, *coarse);
    untangle(mesh_, expected, *fine);
    uncross(mesh_, expected, *fine);

    step("fit: report");
    Result<ReferenceModel> named = withMesh(model_, scan_.name, mesh_.withPositions(*fine));
    if (!named) return named.error();
    Fit fit;
    fit.model = *std::move(named);
    fit.placement.linear() = placement.similarity.scale * placement.similarity.rotation;
    fit.placement.translation() = placement.similarity.shift;
    const std::vector<std::uint32_t> segments =
        segmentOfPoints(mesh_.positions(), placesOf(model_));
    fit.report = judge({*fit.model.mesh, target, placement, expected, segments, options_.limits});
    fit.report.familySize = options_.family.size();
    std::vector<double> misses;
    for (const auto& [name, place] : options_.landmarks) {
      misses.push_back((position(*fit.model.mesh, model_.landmarks.at(name)) - place).norm());
    }
    fit.report.landmarks = summarise(misses, std::vector<double>(misses.size(), 1.0));
    return fit;
  }

 private:
  void step(std::string_view name) {
    if (progress_ != nullptr) progress_->step(name);
  }

  [[nodiscard]] Result<void> check() const {
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
    if (scan_.points.size() < 100) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("the scan {} has {} points; that is too few", scan_.name,
                               scan_.points.size()),
                   {}};
    }
    return {};
  }

  /// A unit that was taken for another is seen at once: everything is 10, 25.4 or 1000 times off.
  [[nodiscard]] Result<void> checkSize(const Target& target) const {
    const double own = (mesh_.boxMax() - mesh_.boxMin()).norm();
    const double ratio = target.diagonal / own;
    if (!(target.diagonal > 0) || !std::isfinite(ratio)) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("the points of {} all lie in one place", scan_.name),
                   {}};
    }
    constexpr double kLeast = 5;
    constexpr double kMost = 20000;
    if (own < kLeast || own > kMost) {
      return Error{
          ErrorCode::UnitsMissing,
          fmt::format("the template {} is {:.4g} mm across: is its unit right? Give --units",
                      model_.name, own),
          {}};
    }
    // Turned boxes differ in their diagonals, by 1.7 at most.
    constexpr double kTurned = 1.8;
    if (ratio > options_.limits.leastScale / kTurned &&
        ratio < options_.limits.mostScale * kTurned) {
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
                    scan_.name, target.diagonal, own,
                    likely.empty() ? "" : ": is it " + likely + "?"),
        {}};
  }

  /// Landmarks that the template has too, its own and the scan's.
  [[nodiscard]] std::pair<std::vector<Eigen::Vector3d>, std::vector<Eigen::Vector3d>> landmarks()
      const {
    std::pair<std::vector<Eigen::Vector3d>, std::vector<Eigen::Vector3d>> pairs;
    for (const auto& [name, place] : options_.landmarks) {
      pairs.first.push_back(position(mesh_, model_.landmarks.at(name)));
      pairs.second.push_back(place);
    }
    return pairs;
  }

  [[nodiscard]] Placement findPlacement(const Target& target) const {
    const Shape shape = makeShape(mesh_.triangles(), mesh_.positions());
    if (options_.landmarks.size() < kEnoughLandmarks)
      return place(shape, target, model_.symmetry.has_value());
    const auto [own, wanted] = landmarks();
    return placeByLandmarks(shape, target, own, wanted);
  }

  [[nodiscard]] Shape placed(const Placement& placement) const {
    std::vector<Eigen::Vector3d> positions;
    for (const Eigen::Vector3d& p : mesh_.positions()) {
      positions.push_back(placement.similarity.apply(p));
    }
    return makeShape(mesh_.triangles(), std::move(positions));
  }

  /// Takes the rest shape and what the family adds to it into the posture that landmarks say;
  /// without them a body's arms to where the scan has them.
  void pose(const Placement& placement, const Target& target, CoarseProblem& problem) const {
    Places own;
    for (const auto& [name, p] : placesOf(model_)) own[name] = placement.similarity.apply(p);
    std::optional<Posed> posed;
    if (options_.landmarks.size() >= kEnoughLandmarks) {
      posed = poseByLandmarks(mesh_, problem.rest.positions, own, options_.landmarks);
    } else {
      const std::vector<std::uint32_t> segmentOf = segmentOfPoints(problem.rest.positions, own);
      const auto arms =
          findArms(problem.rest, segmentOf, own, placement.similarity.rotation, target);
      if (arms) posed = poseBySegments(mesh_, problem.rest.positions, segmentOf, *arms);
    }
    if (!posed) return;
    problem.rest = makeShape(mesh_.triangles(), std::move(posed->positions));
    for (std::vector<Eigen::Vector3d>& added : problem.family) {
      for (std::size_t v = 0; v < added.size(); ++v) added[v] = posed->linear[v] * added[v];
    }
  }

  [[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> familyAround(const Shape& rest) const {
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

  [[nodiscard]] std::vector<Pin> pins() const {
    std::vector<Pin> pins;
    for (const auto& [name, place] : options_.landmarks) {
      const SurfacePoint& point = model_.landmarks.at(name);
      const FaceId face = facesOf(mesh_, point).front();
      const Triangle& t = mesh_.vertices(face);
      pins.push_back(
          {{t[0].index(), t[1].index(), t[2].index()}, barycentricIn(mesh_, point, face), place});
    }
    return pins;
  }

  /// The rest shape with its share of the family, as the graph turns and stretches it.
  [[nodiscard]] Expectation expect(const CoarseProblem& problem, const CoarseFit& coarse) const {
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

  const ReferenceModel& model_;
  const Mesh& mesh_;
  const Scan& scan_;
  const FitOptions& options_;
  Progress* progress_;
};

}  // namespace

Result<Fit> fitTemplate(const ReferenceModel& model, const Scan& scan, const FitOptions& options,
                        Progress* progress) {
  return Fitter(model, scan, options, progress).run();
}

}  // namespace toile
