// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/fit/fit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "fit_cases.h"
#include "support/result_printing.h"
#include "toile/core/parallel.h"
#include "toile/fit/correspondence.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

struct ScanCase {
  std::string from, scan;
  /// Without the scanned body, and without the template's.
  std::vector<std::string> family;
  double meanDistance;
  double mapMedian, mapMedianAlone;  // with the family, and without
};

// The limits are the goals; docs/fitting.md says what was measured.
const std::vector<ScanCase>& scanCases() {
  static const std::vector<ScanCase> cases{
      {"male_average",
       "female_average_remesh",
       {"female_tall_slim", "male_heavy", "child_10y", "elderly"},
       0.6,
       5,
       16},
      {"female_average",
       "male_heavy_holes",
       {"male_average", "female_tall_slim", "child_10y", "elderly"},
       1.3,
       8,
       17},
      {"female_average",
       "child_10y_cloud",
       {"male_average", "female_tall_slim", "male_heavy", "elderly"},
       1.3,
       6,
       8},
  };
  return cases;
}

struct ScanWithTruth {
  Scan scan;
  test::TrueMap truth;
};

ScanWithTruth readScanWithTruth(const std::string& name) {
  const std::filesystem::path folder = test::testDataFolder() / "scans";
  return {readScan(folder / (name + ".ply"), FileUnit::Millimetre).value(),
          test::readTrueMap(folder / (name + ".map.npy"))};
}

/// By how much the closed tailor's curves are longer or shorter than on the true body, ascending.
std::vector<double> girthErrors(const ScanCase& one, const Fit& fit) {
  const ReferenceModel body = test::readBody(one.scan.substr(0, one.scan.find_last_of('_')));
  std::vector<double> errors;
  for (const auto& [name, path] : fit.model.curves) {
    if (!path.closed) continue;
    errors.push_back(std::abs(length(*fit.model.mesh, path) - length(*body.mesh, path)));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

void tell(const ScanCase& one, const Fit& fit, const std::vector<double>& errors) {
  const FitReport& r = fit.report;
  const std::vector<double> girths = girthErrors(one, fit);
  std::cout << fmt::format(
      "{} -> {} (family {}): scan to fit {:.2f} / {:.2f}, map {:.2f} / {:.2f} mm, girths {:.1f} / "
      "{:.1f}, {} flips, {} "
      "crossings\n",
      one.from, one.scan, r.familySize, r.scanToFit.mean, r.scanToFit.percentile95,
      errors[errors.size() / 2], errors[errors.size() * 95 / 100], girths[girths.size() / 2],
      girths.back(), r.flippedFaces, r.crossings);
}

class ScanFit : public ::testing::TestWithParam<int> {};

TEST_P(ScanFit, FindsTheTrueMap) {
  TOILE_BODIES_OR_SKIP();
  const ScanCase& one = scanCases()[static_cast<std::size_t>(GetParam())];
  const auto [scan, truth] = readScanWithTruth(one.scan);
  const ReferenceModel model = test::readBody(one.from);
  for (const bool hasFamily : {true, false}) {
    FitOptions options;
    if (hasFamily) options.family = test::readFamily(one.family);
    const Result<Fit> fit = fitTemplate(model, scan, options);
    ASSERT_TRUE(fit) << fit.error();
    const std::vector<double> errors = test::mapErrors(truth, scan, *fit->model.mesh);
    tell(one, *fit, errors);
    EXPECT_TRUE(fit->report.isOk()) << fit->report.reasons.front().message;
    EXPECT_LE(fit->report.scanToFit.mean, one.meanDistance);
    EXPECT_LE(errors[errors.size() / 2], hasFamily ? one.mapMedian : one.mapMedianAlone);
    EXPECT_EQ(fit->report.flippedFaces, 0U);
    EXPECT_EQ(fit->model.mesh->connectivityHash(), model.mesh->connectivityHash());
  }
}

INSTANTIATE_TEST_SUITE_P(Scans, ScanFit, ::testing::Range(0, 3));

// Wherever the scan lies, head down too, the template ends on it in the same way.
TEST(Fit, FindsAnyPlacement) {
  TOILE_BODIES_OR_SKIP();
  const int trials = test::sweep(1);
  std::mt19937 random(24);
  std::normal_distribution<double> normal(0, 1);
  for (const ScanCase& one : scanCases()) {
    const auto [scan, truth] = readScanWithTruth(one.scan);
    const ReferenceModel model = test::readBody(one.from);
    FitOptions options;
    options.family = test::readFamily(one.family);
    const Result<Fit> asItIs = fitTemplate(model, scan, options);
    ASSERT_TRUE(asItIs) << asItIs.error();
    int same = 0;
    double worst = 0, leastMargin = 1e9;
    for (int trial = 0; trial < trials; ++trial) {
      const Eigen::Quaterniond turn =
          trial == 0
              ? Eigen::Quaterniond(0, 1, 0, 0)  // head down
              : Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                    .normalized();
      const Eigen::Vector3d shift =
          5000 * Eigen::Vector3d(normal(random), normal(random), normal(random));
      Scan moved = scan;
      for (Eigen::Vector3d& p : moved.points) p = turn * p + shift;
      const Result<Fit> fit = fitTemplate(model, moved, options);
      ASSERT_TRUE(fit) << fit.error();
      double apart = 0;
      for (std::size_t v = 0; v < model.mesh->vertexCount(); ++v) {
        const Eigen::Vector3d back =
            turn.inverse() * (fit->model.mesh->position(VertexId(v)) - shift);
        apart += (back - asItIs->model.mesh->position(VertexId(v))).norm();
      }
      apart /= static_cast<double>(model.mesh->vertexCount());
      worst = std::max(worst, apart);
      leastMargin = std::min(leastMargin, fit->report.placementMargin);
      // Samples and nearest points differ a little from place to place.
      if (apart < 1 && fit->report.isOk()) ++same;
    }
    std::cout << fmt::format("{}: {} of {} placements, fits {:.3f} mm apart, margin {:.2f}\n",
                             one.scan, same, trials, worst, leastMargin);
    EXPECT_EQ(same, trials) << one.scan;
  }
}

TEST(Fit, IsTheSameOnAnyNumberOfThreads) {
  TOILE_BODIES_OR_SKIP();
  const auto [scan, truth] = readScanWithTruth("child_10y_cloud");
  const ReferenceModel model = test::readBody("female_average");
  std::vector<std::vector<Eigen::Vector3d>> positions;
  for (const std::size_t threads : {1U, 3U}) {
    const ThreadLimit limit(threads);
    const Result<Fit> fit = fitTemplate(model, scan);
    ASSERT_TRUE(fit) << fit.error();
    positions.push_back(fit->model.mesh->positions());
  }
  EXPECT_TRUE(positions[0] == positions[1]);
}

TEST(Fit, RefusesAnotherUnit) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel model = test::readBody("female_average");
  Scan scan = makeScan("in metres", *model.mesh);
  for (Eigen::Vector3d& p : scan.points) p /= 1000;
  const Result<Fit> fit = fitTemplate(model, scan);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, ErrorCode::UnitsMissing);
  EXPECT_THAT(fit.error().message, HasSubstr("m taken for mm"));
}

TEST(Fit, RefusesUnknownLandmarksAndAForeignFamily) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel model = test::readBody("female_average");
  const Scan scan = makeScan("scan", *model.mesh);
  const Result<Fit> misspelt =
      fitTemplate(model, scan, {.landmarks = {{"crwon", Eigen::Vector3d::Zero()}}});
  ASSERT_FALSE(misspelt);
  EXPECT_THAT(misspelt.error().message, HasSubstr("did you mean \"crown\""));
  const Result<ReferenceModel> foot =
      readModel(test::testDataFolder() / "feet/foot_male_wide_l.ply", FileUnit::Millimetre);
  ASSERT_TRUE(foot) << foot.error();
  const Result<Fit> foreign = fitTemplate(model, scan, {.family = {foot->mesh}});
  ASSERT_FALSE(foreign);
  EXPECT_EQ(foreign.error().code, ErrorCode::ModelMismatch);
}

// There and back between shapes of one connectivity is the identity, bit for bit.
TEST(Correspondence, IsTheIdentityOnOneConnectivity) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel a = test::readBody("female_average");
  const ReferenceModel b = test::readBody("male_heavy");
  const Result<Correspondence> map = Correspondence::onOneConnectivity(a.index, b.index);
  ASSERT_TRUE(map) << map.error();
  for (std::size_t f = 0; f < a.mesh->faceCount(); f += 97) {
    const SurfacePoint p = makeSurfacePoint(*a.mesh, FaceId(f), {0.2, 0.3, 0.5});
    EXPECT_EQ(map->toA(map->toB(p)), p);
  }
}

}  // namespace
}  // namespace toile
