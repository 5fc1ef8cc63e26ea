// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/fit_body.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <numbers>

#include "engine/fit/fit_cases.h"
#include "fit/arms.h"
#include "fit/posture.h"
#include "support/cut_scan.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/core/file.h"

namespace toile {
namespace {

struct Expected {
  std::string scan, body;
  std::map<BodyMeasure, double> mm;  ///< the true body's curves of the same names
};

// The body knows its places from the scan alone, so a level may lie otherwise than on the true
// body.
TEST(FitBody, MeasuresScansOfStrangers) {
  std::vector<Expected> all{{"female_average_remesh",
                             "female_average",
                             {{BodyMeasure::Height, 1650},
                              {BodyMeasure::Chest, 884},
                              {BodyMeasure::Waist, 667},
                              {BodyMeasure::Hip, 956},
                              {BodyMeasure::Thigh, 542},
                              {BodyMeasure::Knee, 344},
                              {BodyMeasure::Calf, 348}}},
                            {"male_heavy_holes",
                             "male_heavy",
                             {{BodyMeasure::Height, 1740},
                              {BodyMeasure::Chest, 1167},
                              {BodyMeasure::Waist, 1060},
                              {BodyMeasure::Hip, 1195},
                              {BodyMeasure::Thigh, 675},
                              {BodyMeasure::Knee, 412},
                              {BodyMeasure::Calf, 438}}},
                            {"child_10y_cloud",
                             "child_10y",
                             {{BodyMeasure::Height, 1385},
                              {BodyMeasure::Chest, 693},
                              {BodyMeasure::Waist, 564},
                              {BodyMeasure::Hip, 753},
                              {BodyMeasure::Thigh, 425},
                              {BodyMeasure::Knee, 283},
                              {BodyMeasure::Calf, 291}}}};
  if (std::getenv("TOILE_FIT_SWEEP") == nullptr) all.resize(1);
  for (const Expected& one : all) {
    TOILE_TEST_DATA_OR_SKIP(file, "scans/" + one.scan + ".ply");
    const Result<Scan> scan = readScan(file, FileUnit::Millimetre);
    ASSERT_TRUE(scan) << scan.error();
    const Result<BodyFit> fit = fitBody(*scan);
    ASSERT_TRUE(fit) << fit.error();
    const FitReport& r = fit->fit.report;
    std::cout << fmt::format("{}: scan to fit {:.2f} / {:.2f}, {:.1f} % stray, {} flips:", one.scan,
                             r.scanToFit.mean, r.scanToFit.percentile95, 100 * r.strayShare,
                             r.flippedFaces);
    EXPECT_TRUE(r.isOk()) << r.reasons.front().message;
    EXPECT_LT(r.scanToFit.mean, 1);
    // Its arms hang otherwise than the body's.
    for (const FitRegion& region : r.regions) {
      if (!region.name.ends_with("arm")) continue;
      EXPECT_LT(region.scanToFit.mean, 1) << region.name;
    }
    ASSERT_EQ(fit->measures.size(), kBodyMeasureCount);
    for (const auto& [measure, mm] : one.mm) {
      const auto i = static_cast<std::size_t>(measure);
      std::cout << fmt::format(" {} {:.0f} ({:.0f})", bodyMeasures()[i].name, fit->measures[i].mm(),
                               mm);
      EXPECT_NEAR(fit->measures[i].mm(), mm, 0.04 * mm) << bodyMeasures()[i].name;
    }
    // Sleeves end at the wrist: where it is, how thick, and how long the arm is down to it.
    const ReferenceModel truth = test::readBody(one.body);
    const auto place = [](const ReferenceModel& model, const std::string& name) {
      return position(*model.mesh, model.landmarks.at(name));
    };
    for (const std::string side : {"_l", "_r"}) {
      const auto elbow = place(truth, "elbow_outer" + side);
      for (const std::string& name : {"wrist_thumb" + side, "wrist_little" + side}) {
        const Eigen::Vector3d off = place(fit->fit.model, name) - place(truth, name);
        const double along = off.dot((place(truth, name) - elbow).normalized());
        std::cout << fmt::format(" {} {:.1f} mm off, {:.1f} along", name, off.norm(), along);
        EXPECT_LT(std::abs(along), 12) << name;
      }
      for (const auto& [curve, error] :
           {std::pair{"wrist_girth" + side, 0.03}, {"arm_outer" + side, 0.06}}) {
        const double mm = length(*truth.mesh, truth.curves.at(curve));
        const double found = length(*fit->fit.model.mesh, fit->fit.model.curves.at(curve));
        std::cout << fmt::format(" {} {:.0f} ({:.0f})", curve, found, mm);
        EXPECT_NEAR(found, mm, error * mm) << curve;
      }
    }
    std::cout << "\n";
    for (const Finding& finding : r.findings) {
      EXPECT_FALSE(finding.code == "fit-region-off" &&
                   finding.message.find("arm") != std::string::npos)
          << finding.message;
    }
  }
}

// The parametric body grows an arm that the scan has not.
TEST(FitBody, SaysThatAnArmIsMissing) {
  TOILE_TEST_DATA_OR_SKIP(file, "bodies/female_average.ply");
  const ReferenceModel woman = readModel(file, FileUnit::Millimetre).value();
  const Scan scan = test::cutScan(*woman.mesh, [](const auto& p) { return p.x() <= 220; });
  const Result<BodyFit> fit = fitBody(scan);
  ASSERT_TRUE(fit) << fit.error();
  ASSERT_FALSE(fit->fit.report.isOk());
  EXPECT_EQ(fit->fit.report.reasons.front().message,
            "there is no scan of the left upper arm, left forearm, left hand: the scan is not "
            "whole");
}

// Somebody who names all 74 places names fingers, too; a slip of the pen is still one.
TEST(FitBody, TakesTheLandmarksOfACyclist) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel cyclist = test::readBody("female_tall_slim_cycling");
  BodyFitOptions options;
  for (const auto& [name, point] : cyclist.landmarks) {
    options.landmarks[name] = position(*cyclist.mesh, point);
  }
  const Scan scan = makeScan("cyclist", *cyclist.mesh);
  const Result<BodyFit> fit = fitBody(scan, options);
  ASSERT_TRUE(fit) << fit.error();
  EXPECT_TRUE(fit->fit.report.isOk()) << fit->fit.report.reasons.front().message;
  EXPECT_TRUE(fit->measures.empty());
  const auto& findings = fit->fit.report.findings;
  const auto unused = std::find_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.code == "fit-landmarks-unused";
  });
  ASSERT_NE(unused, findings.end());
  EXPECT_NE(unused->message.find("index_tip_l"), std::string::npos);
  options.landmarks["indx_tip_l"] = Eigen::Vector3d::Zero();
  EXPECT_FALSE(fitBody(scan, options));
}

// On one connectivity the true place of every vertex is known.
TEST(FindArms, TurnsThemToWhereTheScanHasThem) {
  const Result<ReferenceModel> down = makeBody({});
  ASSERT_TRUE(down) << down.error();
  const std::vector<Eigen::Vector3d>& from = down->mesh->positions();
  fitting::Places own;
  for (const auto& [name, point] : down->landmarks) own[name] = position(*down->mesh, point);
  const std::vector<std::uint32_t> segmentOf = fitting::segmentOfPoints(from, own);
  const fitting::Shape shape = fitting::makeShape(down->mesh->triangles(), from);
  const auto find = [&](const Mesh& scan) {
    return fitting::findArms(shape, segmentOf, own, Eigen::Matrix3d::Identity(),
                             fitting::makeTarget(makeScan("scan", scan)));
  };
  // The left arm raised by 35 degrees and brought forward by 20, the right one lowered by 15.
  const std::vector<fitting::Segment>& segments = fitting::bodySegments();
  std::vector<fitting::Similarity> known(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const bool isLeft = segments[s].name.starts_with("left");
    if (!segments[s].name.ends_with("arm") && !segments[s].name.ends_with("hand")) continue;
    const Eigen::Vector3d shoulder = own.at(isLeft ? "shoulder_l" : "shoulder_r");
    const double degree = std::numbers::pi / 180;
    known[s].rotation = Eigen::AngleAxisd((isLeft ? -20 : 0) * degree, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd((isLeft ? -35 : -15) * degree, Eigen::Vector3d::UnitY())
                            .toRotationMatrix();
    known[s].shift = shoulder - known[s].rotation * shoulder;
  }
  const std::vector<Eigen::Vector3d> to =
      fitting::poseBySegments(*down->mesh, from, segmentOf, known).positions;
  const auto arms = find(down->mesh->withPositions(to));
  ASSERT_TRUE(arms);
  const fitting::Posed posed = fitting::poseBySegments(*down->mesh, from, segmentOf, arms->motions);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    double before = 0, after = 0, count = 0;
    for (std::size_t v = 0; v < from.size(); ++v) {
      if (segmentOf[v] != s) continue;
      before += (from[v] - to[v]).norm();
      after += (posed.positions[v] - to[v]).norm();
      ++count;
    }
    const std::string& name = segments[s].name;
    std::cout << fmt::format("{}: {:.1f} -> {:.1f} mm off\n", name, before / count, after / count);
    if (name.ends_with("hand") || name.ends_with("forearm")) {
      EXPECT_GT(before / count, 50) << name;
      EXPECT_LT(after / count, 0.25 * before / count) << name;
    }
    if (name.ends_with("thigh") || name == "head") {
      EXPECT_LT(after / count, before / count + 3);
    }
  }
  EXPECT_FALSE(find(*down->mesh)) << "arms that lie well are left alone";
}

}  // namespace
}  // namespace toile
