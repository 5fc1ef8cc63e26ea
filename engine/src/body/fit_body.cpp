// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/fit_body.h"

#include <algorithm>
#include <array>
#include <optional>

namespace toile {
namespace {

constexpr std::array kPostures = {Posture::APose, Posture::ArmsRaised, Posture::KneeBent,
                                  Posture::Seated};
/// How much larger a measure is on a member of the family, of the measure.
constexpr double kVaried = 0.06;

using Family = std::vector<std::shared_ptr<const Mesh>>;

void add(Family& family, const BodyOptions& options) {
  const Result<ReferenceModel> body = makeBody(options);
  if (body) family.push_back(body->mesh);
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
  Family family;
  for (const Kind& kind : kKinds) {
    BodyOptions options;
    options.posture = posture;
    options.masculine = kind.masculine;
    options.measures[BodyMeasure::Height] = Length::mm(kind.height);
    options.measures[BodyMeasure::Chest] = Length::mm(kind.chest);
    options.measures[BodyMeasure::Waist] = Length::mm(kind.waist);
    options.measures[BodyMeasure::Hip] = Length::mm(kind.hip);
    add(family, options);
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
    add(family, options);
  }
  // Arms nearer to the trunk or farther from it.
  BodyOptions raised;
  raised.posture = posture == Posture::APose ? Posture::ArmsRaised : Posture::APose;
  raised.masculine = 0.5;
  add(family, raised);
  return family;
}

/// Every measure of a body a little larger, the others as they are.
Family fineFamily(const BodyOptions& body) {
  Family family;
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    const auto given = body.measures.find(info.measure);
    if (given == body.measures.end() || info.measure == BodyMeasure::Height) continue;
    BodyOptions varied = body;
    const std::size_t before = family.size();
    for (const double factor : {1 + kVaried, 1 - kVaried}) {
      if (family.size() > before) break;  // at the end of its range a measure has one way to go
      varied.measures[info.measure] = Length::mm(given->second.mm() * factor);
      add(family, varied);
    }
  }
  BodyOptions form = body;
  form.masculine = body.masculine < 0.5 ? 1 : 0;
  form.measures = {{BodyMeasure::Height, body.measures.at(BodyMeasure::Height)}};
  add(family, form);
  BodyOptions raised = body;
  raised.posture = Posture::ArmsRaised;
  add(family, raised);
  return family;
}

/// The fit as the template stands, in its own size.
Mesh upright(const Fit& fit) {
  Eigen::Affine3d back = fit.placement.inverse();
  back.linear() *= std::cbrt(fit.placement.linear().determinant());
  std::vector<Eigen::Vector3d> positions;
  for (const Eigen::Vector3d& p : fit.model.mesh->positions()) {
    positions.push_back(back.linear() * (p - fit.placement.translation()));
  }
  return fit.model.mesh->withPositions(std::move(positions));
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

/// The parametric body with the measures of the fit, as far as such a body is possible: the great
/// ones first, each brought into the range that those before leave.
std::optional<BodyOptions> bodyLike(const Mesh& standing) {
  const std::vector<Length> measured = measureBody(standing);
  std::vector<BodyMeasure> order{BodyMeasure::Height, BodyMeasure::Chest, BodyMeasure::Waist,
                                 BodyMeasure::Hip, BodyMeasure::InsideLeg};
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    if (std::find(order.begin(), order.end(), info.measure) == order.end()) {
      order.push_back(info.measure);
    }
  }
  std::optional<BodyOptions> best;
  double least = 0;
  for (const double masculine : {0.0, 0.5, 1.0}) {
    BodyOptions options;
    options.masculine = masculine;
    for (const BodyMeasure measure : order) {
      const auto i = static_cast<std::size_t>(measure);
      const Result<std::vector<BodyRange>> ranges = bodyRanges(options);
      if (!ranges) break;
      BodyOptions next = options;
      next.measures[measure] = std::clamp(measured[i], (*ranges)[i].least, (*ranges)[i].most);
      if (makeBody(next)) options = std::move(next);
    }
    const Result<ReferenceModel> body = makeBody(options);
    if (!body || !options.measures.contains(BodyMeasure::Height)) continue;
    const double distance = meanSquare(*body->mesh, standing);
    if (!best || distance < least) {
      least = distance;
      best = options;
    }
  }
  return best;
}

}  // namespace

Result<BodyFit> fitBody(const Scan& scan, const BodyFitOptions& options, Progress* progress) {
  FitOptions common;
  common.landmarks = options.landmarks;
  common.landmarkError = options.landmarkError;
  common.limits = options.limits;

  std::optional<BodyFit> best;
  for (const Posture posture : kPostures) {
    BodyFit tried;
    tried.body.posture = posture;
    tried.body.masculine = 0.5;
    const Result<ReferenceModel> start = makeBody(tried.body);
    if (!start) return start.error();
    common.family = coarseFamily(posture);
    Result<Fit> fit = fitTemplate(*start, scan, common, progress);
    if (!fit) return fit.error();
    tried.fit = *std::move(fit);
    const bool isOk = tried.fit.report.isOk();
    // With landmarks the template is bent to them: one posture serves all.
    const bool isLast = isOk || !options.landmarks.empty();
    if (!best || isOk ||
        tried.fit.report.scanToFit.mean + 1e3 * tried.fit.report.strayShare <
            best->fit.report.scanToFit.mean + 1e3 * best->fit.report.strayShare) {
      best = std::move(tried);
    }
    if (isLast) break;
  }
  if (best->body.posture != Posture::APose || !best->fit.report.isOk()) return *std::move(best);

  const std::optional<BodyOptions> like = bodyLike(upright(best->fit));
  if (like) {
    const Result<ReferenceModel> body = makeBody(*like);
    if (!body) return body.error();
    common.family = fineFamily(*like);
    Result<Fit> fit = fitTemplate(*body, scan, common, progress);
    if (!fit) return fit.error();
    // The second start is nearer; should the fit be worse all the same, the first stays.
    if (fit->report.isOk()) best->fit = *std::move(fit);
    best->body = *like;
  }
  best->measures = measureBody(upright(best->fit));
  return *std::move(best);
}

}  // namespace toile
