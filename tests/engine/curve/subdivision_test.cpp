// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array kRules{SubdivisionRule::Auto, SubdivisionRule::Uniform,
                            SubdivisionRule::Centripetal};

std::vector<Vector2d> subdivide2(const std::vector<Vector2d>& points, bool closed,
                                 SubdivisionRule rule, int rounds = kSubdivisionRounds) {
  return subdivide<2>(points, closed, rule, rounds);
}

/// Sum of the absolute angles by which an open row turns.
double turning(const std::vector<Vector2d>& row) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    const Vector2d u = row[i] - row[i - 1], v = row[i + 1] - row[i];
    sum += std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)));
  }
  return sum;
}

bool crosses(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool crossesItself(const std::vector<Vector2d>& row) {
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < row.size(); ++j) {
      if (crosses(row[i], row[i + 1], row[j], row[j + 1])) return true;
    }
  }
  return false;
}

const std::vector<Vector2d> kUneven{{0, 0}, {4, 0}, {4.2, .3}, {4.2, .8}, {4, 5}};
const std::vector<Vector2d> kEven{{0, 0}, {3, 1}, {5, 4}, {8, 3}, {9, 0}, {12, -2}};

TEST(Subdivision, CountsAsTheContractSays) {
  for (const SubdivisionRule rule : kRules) {
    for (std::size_t n = 2; n <= 6; ++n) {
      const std::vector<Vector2d> points(kEven.begin(),
                                         kEven.begin() + static_cast<std::ptrdiff_t>(n));
      EXPECT_EQ(subdivide2(points, false, rule).size(), 8 * (n - 1) + 1);
      if (n >= 3) {
        EXPECT_EQ(subdivide2(points, true, rule).size(), 8 * n);
      }
      EXPECT_EQ(subdivide2(points, false, rule, 0), points);
    }
  }
}

TEST(Subdivision, InterpolatesTheControlPoints) {
  for (const SubdivisionRule rule : kRules) {
    for (const bool closed : {false, true}) {
      const auto fine = subdivide2(kUneven, closed, rule);
      for (std::size_t i = 0; i < kUneven.size(); ++i) EXPECT_EQ(fine[8 * i], kUneven[i]);
    }
  }
}

TEST(Subdivision, TwoPointsGiveAStraightRow) {
  const std::vector<Vector3d> ends{{1, 2, 3}, {9, -6, 11}};
  for (const SubdivisionRule rule : kRules) {
    const auto row = subdivide<3>(ends, false, rule);
    ASSERT_EQ(row.size(), 9U);
    for (int i = 0; i <= 8; ++i) {
      EXPECT_LT(
          (row[static_cast<std::size_t>(i)] - (ends[0] + i / 8.0 * (ends[1] - ends[0]))).norm(),
          1e-14);
    }
  }
}

// The article's mask reproduces cubics wherever the reflected phantoms have no say: three rounds
// spread an end's influence over less than three spans.
TEST(Subdivision, UniformRuleReproducesCubicsAwayFromTheEnds) {
  const auto cubic = [](double t) {
    return Vector3d(t * t * t - 2 * t, 0.5 * t * t + 1, 3 * t - 0.25 * t * t * t);
  };
  std::vector<Vector3d> points;
  for (int i = 0; i <= 9; ++i) points.push_back(cubic(i));
  const auto fine = subdivide<3>(points, false, SubdivisionRule::Uniform);
  for (std::size_t i = 24; i <= 48; ++i) {
    EXPECT_LT((fine[i] - cubic(static_cast<double>(i) / 8)).norm(), 1e-11) << i;
  }
}

// On equal spans the knots are equal; after a round they are so only nearly.
TEST(Subdivision, CentripetalRuleIsTheUniformOneOnEqualSpans) {
  std::vector<Vector2d> polygon;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * std::numbers::pi * i / 8;
    polygon.emplace_back(std::cos(angle), std::sin(angle));
  }
  const auto uniform = subdivide2(polygon, true, SubdivisionRule::Uniform, 1);
  const auto centripetal = subdivide2(polygon, true, SubdivisionRule::Centripetal, 1);
  for (std::size_t i = 0; i < uniform.size(); ++i) {
    EXPECT_LT((uniform[i] - centripetal[i]).norm(), 1e-13);
  }
}

TEST(Subdivision, CentripetalRuleKeepsAStraightUnevenRowStraightAndOrdered) {
  const std::vector<Vector2d> row{{0, 0}, {10, 10}, {10.5, 10.5}, {11, 11}, {30, 30}, {31, 31}};
  const auto fine = subdivide2(row, false, SubdivisionRule::Centripetal);
  for (std::size_t i = 0; i + 1 < fine.size(); ++i) {
    EXPECT_NEAR(fine[i].x(), fine[i].y(), 1e-12);
    EXPECT_LT(fine[i].x(), fine[i + 1].x());
  }
}

TEST(Subdivision, UnevenSpansDoNotLoop) {
  const auto uniform = subdivide2(kUneven, false, SubdivisionRule::Uniform);
  EXPECT_GT(turning(uniform), 5);  // the trap that the other rule is there for
  EXPECT_TRUE(crossesItself(uniform));

  const auto centripetal = subdivide2(kUneven, false, SubdivisionRule::Centripetal);
  EXPECT_LT(turning(centripetal), 2.3);
  EXPECT_FALSE(crossesItself(centripetal));
  EXPECT_EQ(subdivide2(kUneven, false, SubdivisionRule::Auto), centripetal);
  EXPECT_EQ(subdivide2(kEven, false, SubdivisionRule::Auto),
            subdivide2(kEven, false, SubdivisionRule::Uniform));
}

TEST(Subdivision, TheReversedRowGivesTheReversedCurveBitForBit) {
  for (const SubdivisionRule rule : kRules) {
    for (const auto& points : {kUneven, kEven}) {
      auto reversed = points;
      std::reverse(reversed.begin(), reversed.end());
      auto fine = subdivide2(reversed, false, rule);
      std::reverse(fine.begin(), fine.end());
      EXPECT_EQ(fine, subdivide2(points, false, rule));
    }
  }
}

TEST(Subdivision, AClosedCurveDoesNotKnowWhereItStarts) {
  for (const SubdivisionRule rule : kRules) {
    const auto fine = subdivide2(kUneven, true, rule);
    auto turned = kUneven;
    std::rotate(turned.begin(), turned.begin() + 2, turned.end());
    auto fineTurned = subdivide2(turned, true, rule);
    std::rotate(fineTurned.begin(), fineTurned.end() - 16, fineTurned.end());
    EXPECT_EQ(fineTurned, fine);
  }
}

}  // namespace
}  // namespace toile
