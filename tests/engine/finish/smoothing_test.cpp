// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/result_printing.h"
#include "support/sample_designs.h"

namespace toile {
namespace {

using std::numbers::pi;

Points2 arcPoints(double radius, double angle, int chords) {
  Points2 points;
  for (int i = 0; i <= chords; ++i)
    points.emplace_back(radius * std::cos(angle * i / chords),
                        radius * std::sin(angle * i / chords));
  return points;
}

double lengthOf(const Points2& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

TEST(EqualArc, HasTheLengthOfItsChords) {
  const Points2 points = arcPoints(100, 1.2, 24);
  const std::optional<EqualArc> arc = equalArc(points);
  ASSERT_TRUE(arc);
  EXPECT_TRUE(arc->toLeft);
  const double chord = (points.back() - points.front()).norm();
  EXPECT_NEAR(2 * arc->radius * std::asin(chord / (2 * arc->radius)), lengthOf(points), 1e-9);
  EXPECT_NEAR(arc->radius, 100, 0.1);
  const Points2 back(points.rbegin(), points.rend());
  EXPECT_FALSE(equalArc(back)->toLeft);
}

TEST(EqualArc, IsRefusedWhereItWouldMissAPoint) {
  Points2 points = arcPoints(100, 1.2, 24);
  points[12] *= 1.003;  // 0.3 mm out
  EXPECT_FALSE(equalArc(points));
  EXPECT_EQ(equalArc(Points2{{0, 0}, {5, 0}, {10, 0}})->radius, 0);  // straight
  EXPECT_FALSE(equalArc(arcPoints(10, 1.5 * pi, 60)));               // more than half a circle
}

// The sleeve with and without smoothing: makeSewOutline() gives the exact flat boundary.
TEST(Smoothing, KeepsLengthsAndTheSamePointsOnBothMates) {
  const Result<Pattern> pattern = makePattern(test::sleeveDocument());
  ASSERT_TRUE(pattern) << pattern.error();
  std::size_t before = 0;
  std::size_t after = 0;
  for (std::size_t i = 0; i < pattern->pieces.size(); ++i) {
    const PatternPiece& piece = pattern->pieces[i];
    const std::uint32_t index = pattern->pieceIndex[i];
    const Result<SewOutline> exact =
        makeSewOutline(pattern->cut.pieces[index], *pattern->flats[index]);
    ASSERT_TRUE(exact);
    for (std::size_t l = 0; l < exact->loops.size(); ++l) {
      before += exact->loops[l].size();
      after += piece.sewLines[l].size();
    }
    for (const OutlineRun& run : piece.runs) {
      Points2 points;
      const Outline& loop = piece.sewLines[run.loop];
      for (std::size_t k = 0; k <= run.edgeCount; ++k)
        points.push_back(loop[(run.first + k) % loop.size()].position);
      EXPECT_LE(run.length - lengthOf(points), kSmoothingMm);
      EXPECT_GE(run.length - lengthOf(points), -1e-9);
      ASSERT_GE(run.arcEnds.size(), 2u);
      EXPECT_EQ(run.arcEnds.front(), 0u);
      EXPECT_EQ(run.arcEnds.back(), run.edgeCount);
      if (run.mate.empty()) continue;
      for (const PatternPiece& other : pattern->pieces)
        for (const OutlineRun& mate : other.runs) {
          if (other.id != run.mate || mate.seam != run.seam ||
              std::abs(mate.length - run.length) > 1e-6)
            continue;
          EXPECT_EQ(mate.edgeCount, run.edgeCount);
          EXPECT_EQ(mate.arcEnds.size(), run.arcEnds.size());
        }
    }
  }
  EXPECT_LT(after, before);
}

}  // namespace
}  // namespace toile
