// SPDX-License-Identifier: GPL-3.0-or-later
// What is no scan of the template's kind must never come back as a good fit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <iostream>

#include "fit_cases.h"
#include "support/result_printing.h"

namespace toile {
namespace {

Scan keepFaces(const Mesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& isKept) {
  Scan scan = makeScan("part", mesh);
  scan.triangles.clear();
  for (const Triangle& t : mesh.triangles()) {
    if (std::all_of(t.begin(), t.end(), [&](VertexId v) { return isKept(mesh.position(v)); })) {
      scan.triangles.push_back(t);
    }
  }
  std::vector<VertexId> number(scan.points.size());
  std::vector<Eigen::Vector3d> points;
  for (Triangle& t : scan.triangles) {
    for (VertexId& v : t) {
      if (!number[v.index()].isValid()) {
        number[v.index()] = VertexId(points.size());
        points.push_back(scan.points[v.index()]);
      }
      v = number[v.index()];
    }
  }
  scan.points = std::move(points);
  return scan;
}

Scan readTestScan(const std::string& file) {
  return readScan(test::testDataFolder() / file, FileUnit::Millimetre).value();
}

Scan scaledTo(Scan scan, double factor) {
  for (Eigen::Vector3d& p : scan.points) p *= factor;
  return scan;
}

/// The codes of the reasons; empty for a good fit.
std::string reasonsOf(const std::string& what, const ReferenceModel& model, const Scan& scan) {
  const Result<Fit> fit = fitTemplate(model, scan);
  if (!fit) return std::string(toString(fit.error().code));
  const FitReport& r = fit->report;
  std::string codes;
  for (const Finding& reason : r.reasons) codes += reason.code + " ";
  std::cout << fmt::format(
      "{}: {}({:.1f} % stray, {:.1f} % missing, mean {:.2f} mm, {} flips, scale {:.2f}, mirror "
      "{:.2f}, margin {:.2f})\n",
      what, codes, 100 * r.strayShare, 100 * r.missingShare, r.scanToFit.mean, r.flippedFaces,
      r.scale, r.mirrorScore, r.placementMargin);
  return codes;
}

using ::testing::HasSubstr;

TEST(FitBadInput, IsMarkedWithTheReason) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel woman = test::readBody("female_average");
  const Mesh man = *test::readBody("male_average").mesh;
  EXPECT_THAT(
      reasonsOf("upper half", woman, keepFaces(man, [](const auto& p) { return p.z() > 900; })),
      HasSubstr("fit-missing-scan"));
  EXPECT_THAT(
      reasonsOf("front half", woman, keepFaces(man, [](const auto& p) { return p.y() < 0; })),
      HasSubstr("fit-missing-scan"));
  Scan two = makeScan("two people", man);
  const std::size_t count = two.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    two.points.push_back(woman.mesh->position(VertexId(i)) + Eigen::Vector3d(1100, 200, 0));
  }
  for (const Triangle& t : woman.mesh->triangles()) {
    two.triangles.push_back({VertexId(t[0].index() + count), VertexId(t[1].index() + count),
                             VertexId(t[2].index() + count)});
  }
  EXPECT_THAT(reasonsOf("two people", woman, two), HasSubstr("fit-stray-scan"));
  EXPECT_NE(reasonsOf("chair", woman, readTestScan("toys/armchair.ply")), "");
  EXPECT_NE(reasonsOf("squirrel", woman, scaledTo(readTestScan("toys/squirrel.ply"), 8)), "");
}

TEST(FitBadInput, MirroredFootIsSeen) {
  TOILE_BODIES_OR_SKIP();
  const Result<ReferenceModel> foot =
      readModel(test::testDataFolder() / "feet/foot_female_average_l.ply", FileUnit::Millimetre);
  ASSERT_TRUE(foot) << foot.error();
  Scan left = readTestScan("feet/foot_male_average_l.ply");
  EXPECT_EQ(reasonsOf("left foot", *foot, left), "");
  for (Eigen::Vector3d& p : left.points) p.x() = -p.x();
  Scan insideOut = left;
  EXPECT_THAT(reasonsOf("inside out", *foot, insideOut), HasSubstr("fit-inside-out"));
  for (Triangle& t : left.triangles) std::swap(t[1], t[2]);
  EXPECT_THAT(reasonsOf("right foot", *foot, left), HasSubstr("fit-mirrored"));
}

// Feet, lasts, toys: between any models of one kind, without a family.
TEST(Fit, WorksBetweenFeetAndLasts) {
  TOILE_BODIES_OR_SKIP();
  for (const auto& [from, to] :
       {std::pair{"feet/foot_female_average_l.ply", "feet/foot_child_10y_l.ply"},
        std::pair{"lasts/last_female_average_flat_l.ply", "lasts/last_male_wide_flat_l.ply"}}) {
    const Result<ReferenceModel> model =
        readModel(test::testDataFolder() / from, FileUnit::Millimetre);
    ASSERT_TRUE(model) << model.error();
    EXPECT_EQ(reasonsOf(to, *model, readTestScan(to)), "");
  }
}

}  // namespace
}  // namespace toile
