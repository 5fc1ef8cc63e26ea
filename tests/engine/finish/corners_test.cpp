// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "finish/allowance.h"
#include "finish/polygon.h"

namespace toile {
namespace {

using Eigen::Vector2d;

/// A convex polygon with a run per side; widths in the order of the sides.
SewOutline polygon(const Points2& points, const std::vector<double>& widths) {
  SewOutline sew;
  Outline& loop = sew.loops.emplace_back();
  for (std::size_t i = 0; i < points.size(); ++i) {
    loop.push_back({points[i], true});
    OutlineRun run;
    run.first = i;
    run.edgeCount = 1;
    run.length = (points[(i + 1) % points.size()] - points[i]).norm();
    run.allowance = widths[i];
    sew.runs.push_back(run);
  }
  return sew;
}

bool hasPoint(const Outline& outline, const Vector2d& p) {
  return std::any_of(outline.begin(), outline.end(),
                     [&](const OutlinePoint& q) { return (q.position - p).norm() < 1e-3; });
}

/// A skirt panel: hem of 30 mm below, sides that lean outwards downwards by 10 in 100.
SewOutline flaredPanel() {
  return polygon({{-10, 0}, {110, 0}, {100, 100}, {0, 100}}, {30, 10, 10, 10});
}

TEST(Corners, MirroredHemLiesFlushWhenFoldedUp) {
  const SewOutline sew = flaredPanel();
  std::vector<Corner> corners(4);
  corners[0] = {.style = CornerStyle::Mirrored, .byNext = true};   // the hem begins there
  corners[1] = {.style = CornerStyle::Mirrored, .byNext = false};  // and ends there
  const std::vector<Outline> cut = makeCutLines(sew, corners);
  ASSERT_EQ(cut.size(), 1u);
  // The allowance folded up at y = 0 ends on the side's cut line: mirrored in the sew line, the
  // corner at y = -30 lies on that line's prolongation to y = 30.
  const double lean = 0.1;
  const double cutSide = 110 + 10 * std::sqrt(1 + lean * lean);  // of the right side at y = 0
  EXPECT_TRUE(hasPoint(cut[0], {cutSide, 0}));
  EXPECT_TRUE(hasPoint(cut[0], {cutSide - 30 * lean, -30}));
  EXPECT_TRUE(hasPoint(cut[0], {100 - cutSide + 30 * lean, -30}));
}

TEST(Corners, MirroredHemOfAPieceThatNarrowsCutsIntoNothingElse) {
  // Sides that lean inwards downwards: the hem's end must reach out.
  const SewOutline sew = polygon({{10, 0}, {90, 0}, {100, 100}, {0, 100}}, {30, 10, 10, 10});
  std::vector<Corner> corners(4);
  corners[1] = {.style = CornerStyle::Mirrored, .byNext = false};
  const std::vector<Outline> cut = makeCutLines(sew, corners);
  const double side = 90 + 10 * std::sqrt(1.01);
  EXPECT_TRUE(hasPoint(cut[0], {side, 0}));
  EXPECT_TRUE(hasPoint(cut[0], {side + 3, -30}));
}

TEST(Corners, SquareEndsItsSideAtARightAngle) {
  // A sharp lower right corner of 45 degrees between the base and the slanting side.
  const SewOutline sew = polygon({{0, 0}, {100, 0}, {0, 100}}, {10, 10, 10});
  std::vector<Corner> corners(3);
  corners[1] = {.style = CornerStyle::Square, .byNext = false};
  const std::vector<Outline> cut = makeCutLines(sew, corners);
  const double x = 100 + 10 / std::sin(3 * std::numbers::pi / 4);
  EXPECT_TRUE(hasPoint(cut[0], {x, -10}));
  EXPECT_TRUE(hasPoint(cut[0], {x, 0}));
  const CornerReach reach = cornerReach(sew, 1, corners[1]);
  EXPECT_NEAR(reach.before, x - 100, 1e-9);
}

TEST(Corners, TruncatedIsCutAcrossAnAllowanceAway) {
  const SewOutline sew = polygon({{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {10, 10, 10, 10});
  const std::vector<Corner> corners(4, Corner{.style = CornerStyle::Truncated});
  const std::vector<Outline> cut = makeCutLines(sew, corners);
  EXPECT_EQ(cut[0].size(), 8u);
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(100, 0)}) {
    const EdgeGrid grid(positions(cut));
    EXPECT_NEAR(grid.nearest(corner + Vector2d(corner.x() > 0 ? 50 : -50, -50)).distance,
                50 * std::sqrt(2) - 10, 1e-3);
  }
}

TEST(Corners, ReachThatIsLimitedEndsSquareAndLeavesTheNeighboursAllowance) {
  const SewOutline sew = polygon({{0, 0}, {100, 0}, {0, 100}}, {10, 10, 10});
  std::vector<Corner> corners(3);
  const double whole = cornerReach(sew, 1, corners[1]).before;
  EXPECT_GT(whole, 20);
  corners[1].reachBefore = 12;
  const std::vector<Outline> cut = makeCutLines(sew, corners);
  EXPECT_TRUE(hasPoint(cut[0], {112, -10}));
  // The slanting side keeps its 10 mm everywhere away from the corner.
  EXPECT_NEAR(EdgeGrid(positions(cut)).nearest({60, 40}).distance, 10, 1e-3);
}

/// A square with a dart in its upper edge: mouth from (60, 100) to (40, 100), tip at (50, 40).
SewOutline dartSquare(double width) {
  SewOutline sew = polygon({{0, 0}, {100, 0}, {100, 100}, {60, 100}, {50, 40}, {40, 100}, {0, 100}},
                           {10, 10, width, 10, 10, width, 10});
  for (const std::size_t leg : {3u, 4u}) {
    sew.runs[leg].kind = WireKind::Dart;
    sew.runs[leg].curve = "dart";
    sew.runs[leg].folded = true;
  }
  return sew;
}

TEST(FoldedDart, IsFilledAndItsCapLiesFlushWhenFolded) {
  const SewOutline sew = dartSquare(10);
  const std::vector<FoldedDart> darts = foldedDarts(sew);
  ASSERT_EQ(darts.size(), 1u);
  EXPECT_EQ(darts[0].tips, (std::vector<std::size_t>{4}));
  const std::vector<Outline> cut = makeCutLines(sew);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(isInside(positions(cut), {50, 95}));
  // The legs reach the cut line y = 110 ...
  const double grow = 110.0 - 40;
  const Vector2d a(50 + grow / 6, 110);
  const Vector2d b(50 - grow / 6, 110);
  EXPECT_TRUE(hasPoint(cut[0], a));
  EXPECT_TRUE(hasPoint(cut[0], b));
  // ... and between them stands a cap on the fold, which mirrored in either leg lies on y = 110.
  const auto cap = std::find_if(cut[0].begin(), cut[0].end(), [](const OutlinePoint& p) {
    return std::abs(p.position.x() - 50) < 1e-3 && p.position.y() > 80;
  });
  ASSERT_NE(cap, cut[0].end());
  const Vector2d tip(50, 40);
  for (const Vector2d& on : {a, b}) {
    const Vector2d leg = (on - tip).normalized();
    const Vector2d d = cap->position - tip;
    const Vector2d mirrored = tip + 2 * d.dot(leg) * leg - d;
    EXPECT_NEAR(mirrored.y(), 110, 1e-3);
  }
  Piece piece;
  EXPECT_TRUE(checkCutLines(sew, cut, piece).empty());
}

TEST(FoldedDart, NarrowerThanTheAllowanceIsNoTrouble) {
  SewOutline sew = dartSquare(25);
  for (OutlineRun& run : sew.runs) run.allowance = 25;
  const std::vector<Outline> cut = makeCutLines(sew);
  EXPECT_EQ(cut.size(), 1u);
  Piece piece;
  EXPECT_TRUE(checkCutLines(sew, cut, piece).empty());
}

}  // namespace
}  // namespace toile
