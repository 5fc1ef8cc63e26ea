// SPDX-License-Identifier: GPL-3.0-or-later
// What is no scan of the template's kind must never come back as a good fit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <numbers>

#include "fit/missing_parts.h"
#include "fit_cases.h"
#include "support/cut_scan.h"
#include "support/result_printing.h"

namespace toile {
namespace {

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
      reasonsOf("upper half", woman, test::cutScan(man, [](const auto& p) { return p.z() > 900; })),
      HasSubstr("fit-missing-scan"));
  EXPECT_THAT(
      reasonsOf("front half", woman, test::cutScan(man, [](const auto& p) { return p.y() < 0; })),
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

// A fit fills in what is not there, and what it fills in looks like a body.
TEST(FitBadInput, MissingLimbsAreNamed) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel woman = test::readBody("female_average");
  ReferenceModel nameless = woman;
  nameless.landmarks.clear();
  const Mesh man = *test::readBody("male_average").mesh;
  struct Cut {
    std::string what;
    std::string named;
    std::function<bool(const Eigen::Vector3d&)> isGone;
  };
  // The man is 1770 mm tall, faces -y; his wrists are at (+-500, -200, 1100).
  const std::vector<Cut> cuts{
      {"head", "head", [](const auto& p) { return p.z() > 1510; }},
      {"half a forearm and half a lower leg", "left forearm, left hand, right shank, right foot",
       [](const auto& p) { return (p.x() > 410 && p.z() > 800) || (p.x() < 0 && p.z() < 300); }}};
  for (const Cut& cut : cuts) {
    const Scan scan = test::cutScan(man, [&](const auto& p) { return !cut.isGone(p); });
    const Result<Fit> fit = fitTemplate(woman, scan);
    ASSERT_TRUE(fit) << fit.error();
    ASSERT_FALSE(fit->report.isOk()) << cut.what;
    const Finding& reason = fit->report.reasons.front();
    EXPECT_EQ(reason.code, "fit-missing-part") << cut.what;
    EXPECT_THAT(reason.message, HasSubstr(cut.named + ": the scan is not whole"));
  }
  // A model without landmarks has no words for it, but a place.
  EXPECT_EQ(
      reasonsOf("hand of a nameless model", nameless,
                test::cutScan(man, [&](const auto& p) { return p.x() > -400 || p.y() > -205; })),
      "fit-missing-part ");
}

// Most clothes end at wrists and ankles, and so does what is scanned in a wetsuit.
TEST(FitBadInput, HandsFeetAndHolesAreTold) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel woman = test::readBody("female_average");
  const Mesh man = *test::readBody("male_average").mesh;
  const Result<Fit> fit = fitTemplate(woman, test::cutScan(man, [](const auto& p) {
                                        const bool isHand = std::abs(p.x()) > 400 && p.y() < -205;
                                        return !isHand && p.z() > 90 && p.z() < 1730;
                                      }));
  ASSERT_TRUE(fit) << fit.error();
  EXPECT_TRUE(fit->report.isOk()) << fit->report.reasons.front().message;
  const auto told = [&](const char* code) {
    for (const Finding& finding : fit->report.findings) {
      if (finding.code == code) return finding.message;
    }
    return std::string();
  };
  EXPECT_THAT(told("fit-missing-part"), HasSubstr("left hand, left foot, right hand, right foot"));
  EXPECT_THAT(told("fit-filled-in"), HasSubstr("head "));
}

// A stump that a program closed leaves nothing without scan: the other side tells.
TEST(FitBadInput, LimbDrawnTogetherOverAClosedStumpIsNamed) {
  TOILE_BODIES_OR_SKIP();
  const ReferenceModel woman = test::readBody("female_average");
  const Mesh man = *test::readBody("male_average").mesh;
  Scan scan = makeScan("no left lower leg", man);
  // Everything below the knee drawn together into a rounded end.
  const Eigen::Vector3d knee(150, -20, 450);
  for (Eigen::Vector3d& p : scan.points) {
    if (p.x() > 0 && p.z() < knee.z()) p = knee + 50 * (p - knee).normalized();
  }
  EXPECT_THAT(reasonsOf("closed stump", woman, scan), HasSubstr("fit-missing-part"));
}

TEST(MissingParts, ReachAsFarAsTheyStickOut) {
  // A tube of radius 1 along z from 0 to 6 in rings of one half, closed by flat ends.
  constexpr std::size_t kAround = 96;
  constexpr std::size_t kRings = 13;
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> faces;
  for (std::size_t r = 0; r < kRings; ++r) {
    for (std::size_t i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kAround;
      points.emplace_back(std::cos(angle), std::sin(angle), 0.5 * static_cast<double>(r));
      if (r == 0) continue;
      const std::size_t a = (r - 1) * kAround + i;
      const std::size_t b = (r - 1) * kAround + (i + 1) % kAround;
      faces.push_back({VertexId(a), VertexId(b), VertexId(b + kAround)});
      faces.push_back({VertexId(a), VertexId(b + kAround), VertexId(a + kAround)});
    }
  }
  const std::size_t below = points.size();
  points.emplace_back(0, 0, 0);
  points.emplace_back(0, 0, 6);
  for (std::size_t i = 0; i < kAround; ++i) {
    const std::size_t next = (i + 1) % kAround;
    const std::size_t top = kAround * (kRings - 1);
    faces.push_back({VertexId(next), VertexId(i), VertexId(below)});
    faces.push_back({VertexId(top + i), VertexId(top + next), VertexId(below + 1)});
  }
  const Result<Mesh> tube = makeMesh(points, faces);
  ASSERT_TRUE(tube) << tube.error();
  const auto reachOf = [&](const std::function<bool(double)>& isMissing) {
    std::vector<char> marks;
    for (const Eigen::Vector3d& p : points) marks.push_back(isMissing(p.z()) ? 1 : 0);
    const std::vector<fitting::MissingPart> parts = fitting::findMissingParts(*tube, marks);
    EXPECT_EQ(parts.size(), 1U);
    return parts.empty() ? 0 : parts.front().reach;
  };
  const double unit = 1 / std::sqrt(std::numbers::pi);  // of a tube as long as its radius
  EXPECT_NEAR(reachOf([](double z) { return z >= 6; }), 0, 1e-9) << "a flat hole";
  EXPECT_NEAR(reachOf([](double z) { return z >= 4; }), 2 * unit, 0.01) << "an end";
  EXPECT_NEAR(reachOf([](double z) { return z >= 2 && z <= 4; }), unit, 0.01) << "a band";
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
