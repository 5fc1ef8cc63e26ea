// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "fit_cases.h"
#include "support/result_printing.h"

namespace toile {
namespace {

struct PostureCase {
  std::string from, to;
  std::vector<std::string> family;
  std::size_t flips, turned;
};

/// Points anywhere on the body, not at its vertices, with 1 mm of noise along every axis: the
/// template's own vertices would be found again.
std::pair<Scan, test::TrueMap> resample(const Mesh& body, std::size_t count, std::mt19937& random) {
  std::vector<double> areas;
  for (std::size_t f = 0; f < body.faceCount(); ++f) areas.push_back(body.area(FaceId(f)));
  std::discrete_distribution<std::size_t> face(areas.begin(), areas.end());
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> noise(0, 1 / std::sqrt(3.0));
  std::pair<Scan, test::TrueMap> made;
  made.first.name = "resampled";
  for (std::size_t i = 0; i < count; ++i) {
    const FaceId f(face(random));
    const double root = std::sqrt(uniform(random));
    const double t = uniform(random);
    const Eigen::Vector3d weights(1 - root, root * (1 - t), root * t);
    Eigen::Vector3d p(noise(random), noise(random), noise(random));
    for (Eigen::Index k = 0; k < 3; ++k) {
      p += weights[k] * body.position(body.vertices(f)[static_cast<std::size_t>(k)]);
    }
    made.first.points.push_back(p);
    made.second.face.push_back(f);
    made.second.weights.push_back(weights);
  }
  return made;
}

std::map<std::string, Eigen::Vector3d> landmarksOf(const ReferenceModel& body, double error,
                                                   std::mt19937& random) {
  std::normal_distribution<double> noise(0, error / std::sqrt(3.0));
  std::map<std::string, Eigen::Vector3d> places;
  for (const auto& [name, point] : body.landmarks) {
    places[name] =
        position(*body.mesh, point) + Eigen::Vector3d(noise(random), noise(random), noise(random));
  }
  return places;
}

void expectPosture(const PostureCase& one, double error, double limit) {
  std::mt19937 random(7);
  const ReferenceModel target = test::readBody(one.to);
  const auto [scan, truth] = resample(*target.mesh, 50000, random);
  FitOptions options;
  options.landmarks = landmarksOf(target, error, random);
  options.landmarkError = Length::mm(error);
  options.family = test::readFamily(one.family);
  const Result<Fit> fit = fitTemplate(test::readBody(one.from), scan, options);
  ASSERT_TRUE(fit) << fit.error();
  const std::vector<double> errors = test::mapErrors(truth, scan, *fit->model.mesh);
  // Two ways to count: against the graph's turn, and against the true body.
  std::size_t turned = 0;
  for (std::size_t f = 0; f < target.mesh->faceCount(); ++f) {
    if (fit->model.mesh->normal(FaceId(f)).dot(target.mesh->normal(FaceId(f))) < 0) ++turned;
  }
  std::cout << fmt::format(
      "{} -> {} (landmarks {} mm off): map {:.2f} / {:.2f}, scan to fit {:.2f}, {} flips ({} "
      "against the true body), {} crossings, {}\n",
      one.from, one.to, error, errors[errors.size() / 2], errors[errors.size() * 95 / 100],
      fit->report.scanToFit.mean, fit->report.flippedFaces, turned, fit->report.crossings,
      fit->report.isOk() ? "ok" : fit->report.reasons.front().message);
  EXPECT_LE(errors[errors.size() / 2], limit);
  EXPECT_LE(fit->report.flippedFaces, one.flips);
  EXPECT_LE(turned, one.turned);
}

TEST(FitPosture, FollowsLandmarks) {
  TOILE_BODIES_OR_SKIP();
  for (const PostureCase& one :
       {PostureCase{"male_average", "male_average_knee_bent", {}, 0, 5},
        PostureCase{"female_tall_slim", "female_tall_slim_cycling", {}, 10, 15}}) {
    expectPosture(one, 0, 6);
    if (test::sweep(0) > 0) expectPosture(one, 5, 8);
  }
}

}  // namespace
}  // namespace toile
