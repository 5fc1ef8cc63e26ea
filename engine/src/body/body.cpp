// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "body/body_mesh.h"
#include "body/body_template.h"
#include "body/expected.h"
#include "body/fit_dials.h"
#include "body/posture.h"
#include "toile/core/nearest_name.h"

namespace toile {
namespace {

using body::Form;
using body::Measures;

/// Standard deviations that a measure may lie from what the others lead to expect.
constexpr double kDeviations = 3.5;
/// Of the height; beyond it there is no room for the arms.
constexpr double kMostChest = 0.77;
constexpr double kLeastHeight = 1000, kMostHeight = 2100;
constexpr double kStandardHeightFemale = 1680, kStandardHeightMale = 1800;

std::size_t indexOf(BodyMeasure measure) {
  return static_cast<std::size_t>(measure);
}

Error refusal(std::string message) {
  return {ErrorCode::InvalidArgument, std::move(message), {}};
}

double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// The measures that are known and the form that follows.
struct Wish {
  Form form;
  std::map<BodyMeasure, double> given;  ///< with the height
};

Result<Wish> readWish(const BodyOptions& options) {
  Wish wish;
  if (!(options.masculine >= 0 && options.masculine <= 1)) {
    return refusal("the form must be from 0 (female) to 1 (male)");
  }
  if (options.childlike && !(*options.childlike >= 0 && *options.childlike <= 1)) {
    return refusal("childlike must be from 0 (adult) to 1 (a child of about five)");
  }
  wish.form.masculine = options.masculine;
  for (const auto& [measure, length] : options.measures) {
    if (!(length.mm() > 0 && std::isfinite(length.mm()))) {
      return refusal(fmt::format("{} {} is no length of a body",
                                 bodyMeasures()[indexOf(measure)].name, toString(length)));
    }
    wish.given[measure] = length.mm();
  }
  const auto [height, isStandard] = wish.given.emplace(
      BodyMeasure::Height,
      kStandardHeightFemale + (kStandardHeightMale - kStandardHeightFemale) * options.masculine);
  if (!(height->second >= kLeastHeight && height->second <= kMostHeight)) {
    const double nearest = height->second > kMostHeight ? kMostHeight : kLeastHeight;
    return refusal(
        fmt::format("height {:.0f} mm is not possible: it must be from {:.0f} to {:.0f} "
                    "mm; nearest: {:.0f} mm",
                    height->second, kLeastHeight, kMostHeight, nearest));
  }
  // A small body is a child's unless said otherwise.
  wish.form.childlike =
      options.childlike.value_or(1 - smoothStep((height->second - 1100) / (1550 - 1100)));
  return wish;
}

BodyRange rangeOf(BodyMeasure measure, const Measures& standard,
                  std::map<BodyMeasure, double> given) {
  if (measure == BodyMeasure::Height) {
    return {Length::mm(given.at(measure)), Length::mm(kLeastHeight), Length::mm(kMostHeight)};
  }
  given.erase(measure);
  const body::Expectation expectation(standard, given);
  const double expected = expectation.value(measure);
  const double freedom = std::exp(kDeviations * expectation.deviation(measure));
  double most = expected * freedom;
  if (measure == BodyMeasure::Chest) {
    most = std::min(most, kMostChest * given.at(BodyMeasure::Height));
  }
  return {Length::mm(std::min(expected, most)), Length::mm(std::min(expected / freedom, most)),
          Length::mm(most)};
}

}  // namespace

std::string_view toString(Posture posture) {
  switch (posture) {
    case Posture::APose:
      return "a-pose";
    case Posture::ArmsRaised:
      return "arms-raised";
    case Posture::KneeBent:
      return "knee-bent";
    case Posture::Seated:
      return "seated";
  }
  return "";
}

Result<Posture> parsePosture(std::string_view text) {
  std::vector<std::string> names;
  for (const Posture posture :
       {Posture::APose, Posture::ArmsRaised, Posture::KneeBent, Posture::Seated}) {
    if (text == toString(posture)) return posture;
    names.emplace_back(toString(posture));
  }
  return refusal("there is no posture \"" + std::string(text) + "\"" +
                 suggestion(std::string(text), names));
}

Result<std::vector<BodyRange>> bodyRanges(const BodyOptions& options) {
  const Result<Wish> wish = readWish(options);
  if (!wish) return wish.error();
  const Measures standard = body::standardMeasures(wish->form, wish->given.at(BodyMeasure::Height));
  std::vector<BodyRange> ranges;
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    ranges.push_back(rangeOf(info.measure, standard, wish->given));
  }
  return ranges;
}

Result<Mesh> body::makeBodyMesh(const BodyOptions& options) {
  const Result<Wish> wish = readWish(options);
  if (!wish) return wish.error();
  const Measures standard = body::standardMeasures(wish->form, wish->given.at(BodyMeasure::Height));
  for (const auto& [measure, value] : wish->given) {
    const BodyRange range = rangeOf(measure, standard, wish->given);
    if (value >= range.least.mm() && value <= range.most.mm()) continue;
    const double least = std::ceil(range.least.mm()), most = std::floor(range.most.mm());
    return refusal(fmt::format(
        "{} {:.0f} mm is not possible on this body: with the other measures it must be from {:.0f} "
        "to {:.0f} mm; nearest: {:.0f} mm",
        bodyMeasures()[indexOf(measure)].name, value, least, most,
        value > range.most.mm() ? most : least));
  }
  const body::Expectation expectation(standard, wish->given);
  Measures wanted{};
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    wanted[indexOf(info.measure)] = expectation.value(info.measure);
  }
  const std::optional<body::Points> cage = body::fitDials(wish->form, wanted);
  if (!cage) {
    return refusal(
        "no body has these measures together; leave out or change the one that is most unusual for "
        "the others");
  }
  return body::bodyTemplate().mesh->withPositions(
      body::inPosture(body::meshPositions(*cage), options.posture));
}

Result<ReferenceModel> makeBody(const BodyOptions& options) {
  Result<Mesh> mesh = body::makeBodyMesh(options);
  if (!mesh) return mesh.error();
  ReferenceModel model = makeReferenceModel("body", *std::move(mesh));
  model.curves = body::bodyTemplate().curves;
  model.landmarks = body::bodyTemplate().landmarks;
  model.symmetry = body::bodyTemplate().symmetry;
  return model;
}

std::vector<Length> measureBody(const Mesh& mesh) {
  const std::vector<std::size_t>& needed = body::tape().vertices();
  body::Points places(static_cast<Eigen::Index>(needed.size()), 3);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) = mesh.position(VertexId(needed[i])).transpose();
  }
  std::vector<Length> out;
  for (const double value : body::tape().measure(places)) out.push_back(Length::mm(value));
  return out;
}

}  // namespace toile
