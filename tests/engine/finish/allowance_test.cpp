// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/allowance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "finish/polygon.h"

namespace toile {
namespace {

using std::numbers::pi;

/// One run around each loop; corners where the line turns by more than 20 degrees.
SewOutline outlineOf(const std::vector<Points2>& loops, double allowance) {
  SewOutline sew;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Points2& points = loops[l];
    Outline& loop = sew.loops.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double turn = turnAngle(points[(i + points.size() - 1) % points.size()], points[i],
                                    points[(i + 1) % points.size()]);
      loop.push_back({points[i], std::abs(turn) > kCornerDegrees * pi / 180});
    }
    OutlineRun run;
    run.loop = l;
    run.edgeCount = points.size();
    run.allowance = allowance;
    sew.runs.push_back(run);
  }
  return sew;
}

Points2 circle(double radius, int count, double direction = 1) {
  Points2 points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(radius * std::cos(direction * 2 * pi * i / count),
                        radius * std::sin(direction * 2 * pi * i / count));
  return points;
}

Piece named(const char* name) {
  Piece piece;
  piece.id = piece.name = name;
  return piece;
}

double areaOf(const Outline& outline) {
  return signedArea(positions(outline));
}

TEST(Allowance, MitresTheCornersOfASquare) {
  const SewOutline sew = outlineOf({{{0, 0}, {100, 0}, {100, 60}, {0, 60}}}, 10);
  const std::vector<Outline> cut = makeCutLines(sew);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0].size(), 4u);
  EXPECT_NEAR(areaOf(cut[0]), 120 * 80, 1e-3);
  for (const OutlinePoint& p : cut[0]) EXPECT_TRUE(p.corner);
  EXPECT_TRUE(checkCutLines(sew, cut, named("square")).empty());
}

TEST(Allowance, OfZeroIsTheSewLineItself) {
  const SewOutline sew = outlineOf({circle(100, 77)}, 0);
  const std::vector<Outline> cut = makeCutLines(sew);
  ASSERT_EQ(cut.size(), 1u);
  ASSERT_EQ(cut[0].size(), 77u);
  for (std::size_t i = 0; i < 77; ++i) EXPECT_EQ(cut[0][i].position, sew.loops[0][i].position);
}

TEST(Allowance, KeepsItsDistanceAlongConvexAndConcaveCurves) {
  // A wavy disc: radius 150 with waves of 25 mm, turning tighter than 10 mm nowhere.
  Points2 points;
  for (int i = 0; i < 700; ++i) {
    const double a = 2 * pi * i / 700;
    points.emplace_back((150 + 25 * std::sin(5 * a)) * std::cos(a),
                        (150 + 25 * std::sin(5 * a)) * std::sin(a));
  }
  const SewOutline sew = outlineOf({points}, 10);
  const std::vector<Outline> cut = makeCutLines(sew);
  const EdgeGrid grid({points});
  for (const OutlinePoint& p : cut[0])
    EXPECT_NEAR(grid.nearest(p.position).distance, 10, 0.05);  // chords of arcs and their joins
  EXPECT_TRUE(checkCutLines(sew, cut, named("wavy")).empty());
}

TEST(Allowance, WiderThanAConcaveCurveLeavesNoLoops) {
  // A plate with a slot that ends in a half circle of 6 mm: 10 mm of allowance fill the slot.
  Points2 points{{0, 0}, {200, 0}, {200, 100}, {106, 100}};
  for (int i = 0; i <= 40; ++i)
    points.emplace_back(100 + 6 * std::cos(-pi * i / 40), 40 + 6 * std::sin(-pi * i / 40));
  points.emplace_back(94, 100);
  points.emplace_back(0, 100);
  const SewOutline sew = outlineOf({points}, 10);
  const std::vector<Outline> cut = makeCutLines(sew);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_NEAR(areaOf(cut[0]), 220 * 120, 1);
  EXPECT_TRUE(checkCutLines(sew, cut, named("slotted")).empty());
}

TEST(Allowance, MakesHolesSmaller) {
  const SewOutline sew = outlineOf({circle(100, 400), circle(40, 200, -1)}, 10);
  const std::vector<Outline> cut = makeCutLines(sew);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_NEAR(areaOf(cut[0]), pi * 110 * 110, 20);
  EXPECT_NEAR(areaOf(cut[1]), -pi * 30 * 30, 5);
  EXPECT_TRUE(checkCutLines(sew, cut, named("ring")).empty());
}

TEST(Allowance, ThatFillsAHoleIsTold) {
  const SewOutline sew = outlineOf({circle(100, 400), circle(8, 60, -1)}, 10);
  const std::vector<Outline> cut = makeCutLines(sew);
  EXPECT_EQ(cut.size(), 1u);
  const std::vector<Finding> findings = checkCutLines(sew, cut, named("ring"));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "allowance-closes-hole");
  EXPECT_EQ(findings[0].where, std::vector<Element>{Element::piece("ring")});
}

TEST(Allowance, CutsOffTheMitreOfASharpCorner) {
  const SewOutline sew = outlineOf({{{0, 0}, {200, -10}, {200, 10}}}, 10);
  const std::vector<Outline> cut = makeCutLines(sew);
  double farthest = 0;
  for (const OutlinePoint& p : cut[0]) farthest = std::max(farthest, -p.position.x());
  EXPECT_NEAR(farthest, kMitreLimit * 10, 1e-3);
  EXPECT_TRUE(checkCutLines(sew, cut, named("wedge")).empty());
}

TEST(Allowance, OfItsOwnForEachEdge) {
  SewOutline sew = outlineOf({{{0, 0}, {100, 0}, {100, 60}, {0, 60}}}, 0);
  sew.runs.clear();
  for (std::size_t i = 0; i < 4; ++i) {
    OutlineRun run;
    run.first = i;
    run.edgeCount = 1;
    run.allowance = std::array<double, 4>{20, 10, 0, 5}[i];
    sew.runs.push_back(run);
  }
  const std::vector<Outline> cut = makeCutLines(sew);
  EXPECT_NEAR(areaOf(cut[0]), (5 + 100 + 10) * (20 + 60 + 0), 1e-3);
  EXPECT_EQ(cut[0].size(), 4u);
  EXPECT_TRUE(checkCutLines(sew, cut, named("edges")).empty());
}

TEST(Allowance, CheckSeesALineThatIsTooNear) {
  const SewOutline sew = outlineOf({circle(100, 400)}, 10);
  std::vector<Outline> cut = makeCutLines(sew);
  for (OutlinePoint& p : cut[0])
    if (p.position.x() > 90) p.position.x() -= 0.5;
  const std::vector<Finding> findings = checkCutLines(sew, cut, named("disc"));
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].code, "allowance-differs");
  EXPECT_EQ(findings[1].code, "allowance-too-narrow");
}

}  // namespace
}  // namespace toile
