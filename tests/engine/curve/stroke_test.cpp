// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/stroke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "support/result_printing.h"
#include "toile/curve/subdivision.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

/// Samples along a row of lines, 2 mm apart, as an unsteady hand draws them.
std::vector<StrokeSample> drawn(const std::vector<Vector2d>& corners, double trembling,
                                bool withTime = false, double spacing = 2) {
  std::mt19937 random(7);
  const auto noise = [&] { return trembling * (static_cast<double>(random()) / 2147483648.0 - 1); };
  std::vector<StrokeSample> stroke;
  double time = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector2d d = corners[i + 1] - corners[i];
    const int count = std::max(1, static_cast<int>(d.norm() / spacing));
    for (int k = 0; k < count; ++k) {
      // The pen slows down at the ends of each line.
      const double t = static_cast<double>(k) / count;
      time += withTime ? 0.01 / (0.2 + std::sin(pi * std::clamp(t, 0.02, 0.98))) : 0;
      stroke.push_back({corners[i] + t * d + Vector2d(noise(), noise()), time, 1});
    }
  }
  stroke.push_back({corners.back(), time + (withTime ? 0.01 : 0), 1});
  return stroke;
}

double turning(const FittedStroke& fitted) {
  const auto row = subdivideWithCorners<2>(fitted.controls, fitted.closed, fitted.corners);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    const Vector2d a = row[i] - row[i - 1], b = row[i + 1] - row[i];
    sum += std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  }
  return sum;
}

TEST(Stroke, TakesTheTremblingOutOfAStraightLine) {
  const auto fitted = fitStroke(drawn({{0, 0}, {400, 100}}, 2), {.tolerance = 5, .closed = {}});
  ASSERT_TRUE(fitted) << fitted.error();
  EXPECT_EQ(fitted->controls.size(), 2U);
  EXPECT_TRUE(fitted->corners.empty());
  EXPECT_FALSE(fitted->closed);
  EXPECT_LE(fitted->deviation, 5);
  EXPECT_NEAR((fitted->controls.back() - fitted->controls.front()).norm(), std::hypot(400, 100), 5);
}

TEST(Stroke, DrawsAnArcOfFewControls) {
  std::vector<Vector2d> arc;
  for (int i = 0; i <= 200; ++i)
    arc.push_back(150 * Vector2d(std::cos(pi * i / 200), std::sin(pi * i / 200)));
  const auto fitted = fitStroke(drawn(arc, 1.5), {.tolerance = 5, .closed = {}});
  ASSERT_TRUE(fitted) << fitted.error();
  EXPECT_LE(fitted->controls.size(), 7U);
  EXPECT_TRUE(fitted->corners.empty());
  for (const Vector2d& p : subdivide<2>(fitted->controls, false)) EXPECT_NEAR(p.norm(), 150, 6);
  // Half a turn and little more: the trembling is gone.
  EXPECT_LT(turning(*fitted), 1.2 * pi);
}

TEST(Stroke, KeepsCornersThatWereMeant) {
  for (const bool withTime : {false, true}) {
    const auto fitted = fitStroke(drawn({{0, 0}, {200, 0}, {200, 150}, {350, 220}}, 1.5, withTime),
                                  {.tolerance = 5, .closed = {}});
    ASSERT_TRUE(fitted) << fitted.error();
    // The turn of 90 degrees is a corner; that of 65 is one where the pen slowed down, and may be
    // one without time.
    ASSERT_GE(fitted->corners.size(), withTime ? 2U : 1U);
    ASSERT_LE(fitted->corners.size(), 2U);
    EXPECT_LT((fitted->controls[fitted->corners[0]] - Vector2d(200, 0)).norm(), 6);
    EXPECT_LE(fitted->controls.size(), 6U);
    EXPECT_LE(fitted->deviation, 5);
  }
}

TEST(Stroke, ATightArcIsNoCorner) {
  std::vector<Vector2d> row{{-200, 0}};
  for (int i = 0; i <= 30; ++i) {
    const double a = pi / 2 * i / 30;
    row.push_back(60 * Vector2d(std::sin(a), 1 - std::cos(a)));
  }
  row.emplace_back(60, 300);
  const auto fitted = fitStroke(drawn(row, 1), {.tolerance = 5, .closed = {}});
  ASSERT_TRUE(fitted) << fitted.error();
  EXPECT_TRUE(fitted->corners.empty());
}

TEST(Stroke, ClosesWhereTheHandCameBack) {
  std::vector<Vector2d> ring;
  for (int i = -4; i <= 210; ++i) {
    const double a = 2 * pi * i / 200;
    ring.push_back(120 * Vector2d(std::cos(a), 0.7 * std::sin(a)));
  }
  const auto fitted = fitStroke(drawn(ring, 1.5), {.tolerance = 5, .closed = {}});
  ASSERT_TRUE(fitted) << fitted.error();
  EXPECT_TRUE(fitted->closed);
  EXPECT_TRUE(fitted->corners.empty());
  EXPECT_LE(fitted->controls.size(), 12U);
  const auto open = fitStroke(drawn(ring, 1.5), {.tolerance = 5, .closed = false});
  ASSERT_TRUE(open) << open.error();
  EXPECT_FALSE(open->closed);

  const auto square = fitStroke(drawn({{0, 0}, {200, 0}, {200, 200}, {0, 200}, {0, 2}}, 1),
                                {.tolerance = 5, .closed = {}});
  ASSERT_TRUE(square) << square.error();
  EXPECT_TRUE(square->closed);
  EXPECT_EQ(square->corners.size(), 4U);
  const auto row = subdivideWithCorners<2>(square->controls, true, square->corners);
  EXPECT_EQ(row.size(), 8 * square->controls.size());
}

TEST(Stroke, CutsHooksOff) {
  std::vector<StrokeSample> stroke = drawn({{0, 0}, {300, 0}}, 0);
  for (int i = 1; i < 8; ++i) stroke.push_back({{300 + i, -4.0 * i}, 0, 0.02});
  const auto fitted = fitStroke(stroke, {.tolerance = 3, .closed = {}});
  ASSERT_TRUE(fitted) << fitted.error();
  EXPECT_NEAR(fitted->controls.back().y(), 0, 1e-6);
}

TEST(Stroke, RefusesWhatIsNoStroke) {
  const auto code = [](const std::vector<StrokeSample>& stroke, double tolerance = 5) {
    const auto fitted = fitStroke(stroke, {.tolerance = tolerance, .closed = {}});
    EXPECT_FALSE(fitted);
    return fitted ? ErrorCode::Cancelled : fitted.error().code;
  };
  EXPECT_EQ(code({}), ErrorCode::CurveInvalid);
  EXPECT_EQ(code({{{1, 2}, 0, 1}}), ErrorCode::CurveInvalid);
  EXPECT_EQ(code({{{1, 2}, 0, 1}, {{1, 2}, 1, 1}, {{1, 2}, 2, 1}}), ErrorCode::CurveInvalid);
  EXPECT_EQ(code({{{1, 2}, 0, 1}, {{2, 2}, 1, 1}}), ErrorCode::CurveInvalid);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code({{{1, nan}, 0, 1}, {{200, 2}, 1, 1}}), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(drawn({{0, 0}, {300, 0}}, 0), 0), ErrorCode::InvalidArgument);
}

TEST(Stroke, TwoSamplesAreAStraightLine) {
  const std::vector<StrokeSample> stroke{{{0, 0}, 0, 1}, {{100, 0}, 0, 1}};
  const auto fitted = fitStroke(stroke);
  ASSERT_TRUE(fitted) << fitted.error();
  EXPECT_EQ(fitted->controls.size(), 2U);
}

TEST(Subdivision, CornersBreakTheCurveOff) {
  const std::vector<Vector2d> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const std::vector<std::size_t> all{0, 1, 2, 3}, one{2};
  for (const Vector2d& p : subdivideWithCorners<2>(square, true, all)) {
    EXPECT_TRUE(p.minCoeff() == 0 || p.maxCoeff() == 10) << p.transpose();
  }
  const auto row = subdivideWithCorners<2>(square, true, one);
  ASSERT_EQ(row.size(), 32U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(row[8 * i], square[i]);
  EXPECT_EQ(subdivideWithCorners<2>(square, false, {}), subdivide<2>(square, false));
}

}  // namespace
}  // namespace toile
