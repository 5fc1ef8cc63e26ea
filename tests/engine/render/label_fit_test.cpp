// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/label_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "finish/polygon.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Loop = std::vector<Vector2d>;

Loop rectangle(double width, double height, double angle = 0, Vector2d middle = {300, 300}) {
  Loop loop;
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    const Vector2d p(x * width, y * height);
    loop.emplace_back(middle + Vector2d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                                        std::sin(angle) * p.x() + std::cos(angle) * p.y()));
  }
  return loop;
}

/// The corners of the text where it is put.
Loop boxOf(const LabelPlace& place, const LabelBlock& block) {
  return rectangle(place.size * block.width, place.size * block.height, place.angle, place.middle);
}

bool isWithinRectangle(const Vector2d& p, double width, double height, double angle) {
  const Vector2d d = p - Vector2d(300, 300);
  const double x = std::cos(angle) * d.x() + std::sin(angle) * d.y();
  const double y = -std::sin(angle) * d.x() + std::cos(angle) * d.y();
  return std::abs(x) <= width / 2 + 1e-9 && std::abs(y) <= height / 2 + 1e-9;
}

const std::vector<LabelBlock> kOneLine = {{8, 1.2}};
const std::vector<LabelBlock> kOneOrTwo = {{8, 1.2, 1}, {4, 2.4, 0.9}};

TEST(FitLabel, StaysWithinNarrowPiecesInEveryDirection) {
  for (int degrees = -90; degrees < 90; degrees += 15) {
    const double angle = degrees * std::numbers::pi / 180;
    const LabelRoom room{{rectangle(150, 18, angle)}, {}, {300, 300}};
    const auto place = fitLabel(room, kOneLine, /*mostSize=*/100, 6);  // as large as can be
    ASSERT_TRUE(place) << degrees;
    EXPECT_GE(place->size, 6);
    for (const Vector2d& corner : boxOf(*place, kOneLine[0])) {
      EXPECT_TRUE(isWithinRectangle(corner, 150, 18, angle)) << degrees;
    }
    EXPECT_LE(std::abs(place->angle), std::numbers::pi / 2 + 1e-12) << "upside down";
  }
}

TEST(FitLabel, StandsLevelWhereThereIsRoom) {
  const LabelRoom room{{rectangle(200, 200)}, {}, {290, 310}};
  const auto place = fitLabel(room, kOneOrTwo, 12, 6);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->block, 0U);
  EXPECT_EQ(place->angle, 0);
  EXPECT_EQ(place->size, 12);
  EXPECT_LT((place->middle - room.wish).norm(), 1e-9);
}

TEST(FitLabel, BreaksTheTextWhereThatIsLarger) {
  const LabelRoom room{{rectangle(56, 60)}, {}, {300, 300}};
  const auto place = fitLabel(room, kOneOrTwo, 12, 6);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->block, 1U);
  EXPECT_GT(place->size, 10);
}

TEST(FitLabel, KeepsClearOfLinesWhereItCan) {
  const LabelRoom room{{rectangle(120, 200)}, {{{200, 300}, {400, 300}}}, {300, 300}};
  const auto place = fitLabel(room, kOneLine, 12, 6);
  ASSERT_TRUE(place);
  EXPECT_GT(std::abs(place->middle.y() - 300), 0.6 * place->size);
}

TEST(FitLabel, IsNotSetWhereItDoesNotFit) {
  EXPECT_FALSE(fitLabel({{rectangle(40, 6)}, {}, {300, 300}}, kOneOrTwo, 12, 6));
  EXPECT_FALSE(fitLabel({{}, {}, {0, 0}}, kOneLine, 12, 6));
}

TEST(FitLabel, KeepsOutOfHoles) {
  const LabelRoom room{{rectangle(160, 160), rectangle(110, 110)}, {}, {300, 300}};
  const auto place = fitLabel(room, kOneLine, 12, 6);
  ASSERT_TRUE(place);
  for (const Vector2d& corner : boxOf(*place, kOneLine[0])) {
    EXPECT_TRUE(isWithinRectangle(corner, 160, 160, 0));
    EXPECT_FALSE(isWithinRectangle(corner, 109, 109, 0));
  }
}

}  // namespace
}  // namespace toile
