// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/fit_body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "body/body_mesh.h"
#include "fit/fitter.h"
#include "fit/segments.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

constexpr std::array kPostures = {Posture::APose, Posture::ArmsRaised, Posture::KneeBent,
                                  Posture::Seated};
/// How much larger a measure is on a member of the family, of the measure.
constexpr double kVaried = 0.06;
/// Of the limits of what may be stray and missing, added: a posture below it needs no other to be
/// tried, and one above it is none.
constexpr double kPlainlyIn = 1.5;
constexpr double kPossible = 4;

using body::makeBodyMesh;
using fitting::Draft;
using fitting::Fitter;
using fitting::Misfit;
using fitting::prepareTarget;
using fitting::Similarity;
using fitting::Target;
using Family = std::vector<std::shared_ptr<const Mesh>>;

/// The bodies that are possible, in the order of the options.
Family makeFamily(const std::vector<BodyOptions>& members) {
  Family made(members.size());
  parallelFor(members.size(), [&](std::size_t i) {
    Result<Mesh> body = makeBodyMesh(members[i]);
    if (body) made[i] = std::make_shared<const Mesh>(*std::move(body));
  });
  std::erase(made, nullptr);
  return made;
}

/// What people differ in most: form, growth, stoutness, proportions.
Family coarseFamily(Posture posture) {
  struct Kind {
    double masculine, height, chest, waist, hip;  // mm
  };
  constexpr std::array<Kind, 7> kKinds = {{{0, 1680, 880, 700, 960},
                                           {1, 1780, 1000, 860, 1000},
                                           {0, 1680, 1120, 980, 1180},
                                           {1, 1780, 1180, 1120, 1140},
                                           {0.5, 1250, 640, 570, 680},
                                           {0, 1780, 840, 640, 900},
                                           {1, 1900, 940, 780, 940}}};
  std::vector<BodyOptions> family;
  for (const Kind& kind : kKinds) {
    BodyOptions options;
    options.posture = posture;
    options.masculine = kind.masculine;
    options.measures[BodyMeasure::Height] = Length::mm(kind.height);
    options.measures[BodyMeasure::Chest] = Length::mm(kind.chest);
    options.measures[BodyMeasure::Waist] = Length::mm(kind.waist);
    options.measures[BodyMeasure::Hip] = Length::mm(kind.hip);
    family.push_back(options);
  }
  // Proportions, on a body between the forms.
  for (const BodyMeasure measure :
       {BodyMeasure::ArmLength, BodyMeasure::InsideLeg, BodyMeasure::BackLength,
        BodyMeasure::ShoulderLength, BodyMeasure::Neck, BodyMeasure::Wrist,
        BodyMeasure::FootLength}) {
    BodyOptions options;
    options.posture = posture;
    options.masculine = 0.5;
    const Result<std::vector<BodyRange>> ranges = bodyRanges(options);
    if (!ranges) continue;
    const BodyRange& range = (*ranges)[static_cast<std::size_t>(measure)];
    options.measures[measure] = Length::mm(0.4 * range.expected.mm() + 0.6 * range.most.mm());
    family.push_back(options);
  }
  // Arms nearer to the trunk or farther from it.
  BodyOptions raised;
  raised.posture = posture == Posture::APose ? Posture::ArmsRaised : Posture::APose;
  raised.masculine = 0.5;
  family.push_back(raised);
  return makeFamily(family);
}

/// Every measure of a body a little larger, the others as they are; smaller where it cannot be.
Family fineFamily(const BodyOptions& body) {
  std::vector<BodyOptions> family;
  const Result<std::vector<BodyRange>> ranges = bodyRanges(body);
  for (const auto& [measure, given] : body.measures) {
    if (!ranges || measure == BodyMeasure::Height) continue;
    const bool hasRoom =
        given.mm() * (1 + kVaried) <= (*ranges)[static_cast<std::size_t>(measure)].most.mm();
    BodyOptions varied = body;
    varied.measures[measure] = Length::mm(given.mm() * (hasRoom ? 1 + kVaried : 1 - kVaried));
    family.push_back(varied);
  }
  BodyOptions form = body;
  form.masculine = body.masculine < 0.5 ? 1 : 0;
  form.measures = {{BodyMeasure::Height, body.measures.at(BodyMeasure::Height)}};
  family.push_back(form);
  BodyOptions raised = body;
  raised.posture = Posture::ArmsRaised;
  family.push_back(raised);
  return makeFamily(family);
}

/// Positions on the scan as the template stands, in the scan's size.
Mesh upright(const Mesh& connectivity, const std::vector<Eigen::Vector3d>& positions,
             const Eigen::Affine3d& placement) {
  const double scale = std::cbrt(placement.linear().determinant());
  const Eigen::Matrix3d back = placement.linear().transpose() / scale;
  std::vector<Eigen::Vector3d> standing;
  for (const Eigen::Vector3d& p : positions) {
    standing.emplace_back(back * (p - placement.translation()));
  }
  return connectivity.withPositions(std::move(standing));
}

double meanSquare(const Mesh& a, const Mesh& b) {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  const double count = static_cast<double>(a.vertexCount());
  for (std::size_t v = 0; v < a.vertexCount(); ++v) {
    shift += (b.position(VertexId(v)) - a.position(VertexId(v))) / count;
  }
  double sum = 0;
  for (std::size_t v = 0; v < a.vertexCount(); ++v) {
    sum += (b.position(VertexId(v)) - a.position(VertexId(v)) - shift).squaredNorm();
  }
  return sum / count;
}

/// The body of a form with those measures, as far as it is possible: the great ones first, each
/// brought into the range that those before leave.
BodyOptions bodyWith(const std::vector<Length>& measured, double masculine) {
  std::vector<BodyMeasure> order{BodyMeasure::Height, BodyMeasure::Chest, BodyMeasure::Waist,
                                 BodyMeasure::Hip, BodyMeasure::InsideLeg};
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    if (std::find(order.begin(), order.end(), info.measure) == order.end()) {
      order.push_back(info.measure);
    }
  }
  // Mostly all are possible together, which one body shows; otherwise each is tried.
  for (const bool isTried : {false, true}) {
    BodyOptions options;
    options.masculine = masculine;
    for (const BodyMeasure measure : order) {
      const auto i = static_cast<std::size_t>(measure);
      const Result<std::vector<BodyRange>> ranges = bodyRanges(options);
      if (!ranges) break;
      BodyOptions next = options;
      next.measures[measure] = std::clamp(measured[i], (*ranges)[i].least, (*ranges)[i].most);
      if (!isTried || makeBodyMesh(next)) options = std::move(next);
    }
    if (isTried || makeBodyMesh(options)) return options;
  }
  return {};
}

/// The parametric body nearest to one.
std::optional<BodyOptions> bodyLike(const Mesh& standing) {
  const std::vector<Length> measured = measureBody(standing);
  constexpr std::array kForms = {0.0, 0.5, 1.0};
  std::array<BodyOptions, kForms.size()> options;
  std::array<double, kForms.size()> distance{};
  parallelFor(kForms.size(), [&](std::size_t i) {
    options[i] = bodyWith(measured, kForms[i]);
    const Result<Mesh> body = makeBodyMesh(options[i]);
    const bool isBody = body && options[i].measures.contains(BodyMeasure::Height);
    distance[i] = isBody ? meanSquare(*body, standing) : std::numeric_limits<double>::infinity();
  });
  const auto best = std::min_element(distance.begin(), distance.end()) - distance.begin();
  if (!std::isfinite(distance[static_cast<std::size_t>(best)])) return std::nullopt;
  return options[static_cast<std::size_t>(best)];
}

/// Names of people's landmarks that the body has no place for: its hands are mittens.
std::vector<std::string> landmarksWithoutPlace(
    const std::map<std::string, Eigen::Vector3d>& landmarks, const ReferenceModel& body) {
  std::vector<std::string> known;
  for (const fitting::Segment& segment : fitting::bodySegments()) {
    for (std::string& name : segment.all()) known.push_back(std::move(name));
  }
  std::vector<std::string> without;
  for (const auto& [name, place] : landmarks) {
    if (body.landmarks.contains(name)) continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) without.push_back(name);
  }
  return without;
}

Eigen::Affine3d affineOf(const Similarity& similarity) {
  Eigen::Affine3d affine;
  affine.linear() = similarity.scale * similarity.rotation;
  affine.translation() = similarity.shift;
  return affine;
}

}  // namespace

Result<BodyFit> fitBody(const Scan& scan, const BodyFitOptions& options, Progress* progress) {
  FitOptions common;
  common.landmarks = options.landmarks;
  common.landmarkError = options.landmarkError;
  common.hasMittens = true;
  common.limits = options.limits;
  const Error cancelled{ErrorCode::Cancelled, "the fit was cancelled", {}};

  std::vector<std::string> unused;
  if (!common.landmarks.empty()) {
    const Result<ReferenceModel> standing = makeBody({});
    if (!standing) return standing.error();
    unused = landmarksWithoutPlace(common.landmarks, *standing);
    for (const std::string& name : unused) common.landmarks.erase(name);
  }

  if (progress != nullptr) progress->step("fit: scan");
  Result<Target> target = prepareTarget(scan);
  if (!target) return target.error();
  struct Try {
    BodyOptions body;
    ReferenceModel model;
    FitOptions options;
    Draft draft;
    double misfit = 0;
  };
  std::optional<Try> best;
  for (const Posture posture : kPostures) {
    Try one;
    one.body.posture = posture;
    one.body.masculine = 0.5;
    Result<ReferenceModel> model = makeBody(one.body);
    if (!model) return model.error();
    one.model = *std::move(model);
    one.options = common;
    one.options.family = coarseFamily(posture);
    const Fitter fitter(one.model, scan.name, one.options, progress);
    if (const Result<void> fine = fitter.check(*target); !fine) return fine.error();
    std::optional<Draft> draft = fitter.draft(*target);
    if (!draft) return cancelled;
    one.draft = *std::move(draft);
    const Misfit off = fitter.misfit(one.draft, *target);
    one.misfit = off.strayShare / options.limits.strayShare.value() +
                 off.missingShare / options.limits.missingShare.value();
    if (!best || one.misfit < best->misfit) best = std::move(one);
    // With landmarks the template is bent to them: one posture serves all.
    if (best->misfit < kPlainlyIn || !common.landmarks.empty()) break;
  }

  BodyFit result;
  result.body = best->body;
  const Fitter coarse(best->model, scan.name, best->options, progress);
  std::optional<Result<Fit>> fit;
  const bool isAPose = best->body.posture == Posture::APose;
  if (isAPose && best->misfit < kPossible) {
    const std::optional<BodyOptions> like =
        bodyLike(upright(*best->model.mesh, best->draft.coarse.positions,
                         affineOf(best->draft.placement.similarity)));
    if (like) {
      const Result<ReferenceModel> body = makeBody(*like);
      if (!body) return body.error();
      common.family = fineFamily(*like);
      // Together with what the first fit had: that may have come to the wrong level of the bust.
      common.family.insert(common.family.end(), best->options.family.begin(),
                           best->options.family.end());
      const Fitter fitter(*body, scan.name, common, progress);
      const std::optional<Draft> draft = fitter.draftFrom(best->draft, *target);
      if (!draft) return cancelled;
      fit = fitter.finish(*draft, *target);
      result.body = *like;
    }
  }
  if (!fit) fit = coarse.finish(best->draft, *target);
  if (!*fit) return fit->error();
  result.fit = **std::move(fit);
  if (!unused.empty()) {
    result.fit.report.findings.push_back(
        {"fit-landmarks-unused",
         fmt::format("the body has no place for these landmarks: {}", fmt::join(unused, ", ")),
         {}});
  }
  // Landmarks may have bent it into any posture.
  if (isAPose && common.landmarks.empty() && result.fit.report.isOk()) {
    const Fit& done = result.fit;
    result.measures =
        measureBody(upright(*done.model.mesh, done.model.mesh->positions(), done.placement));
  }
  return result;
}

}  // namespace toile
