// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/layout/nest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "layout/row_shape.h"
#include "support/result_printing.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector2d;

NestPart rectangle(double length, double height, int count = 1) {
  NestPart part;
  part.name = "rectangle";
  part.outline = {{0, 0}, {length, 0}, {length, height}, {0, height}};
  part.count = count;
  return part;
}

/// A star-shaped outline with notches, so that it is not convex.
NestPart blob(unsigned seed, double size) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> radius(0.45, 1.0);
  NestPart part;
  part.name = "blob " + std::to_string(seed);
  constexpr int kCorners = 17;
  for (int i = 0; i < kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    part.outline.emplace_back(size * radius(random) * Vector2d(std::cos(a), 0.7 * std::sin(a)));
  }
  return part;
}

Points2 cutLine(const NestPart& part, const NestPlace& place) {
  Points2 out;
  for (const Vector2d& p : part.outline) out.push_back(place.apply(p));
  if (place.mirrored) std::reverse(out.begin(), out.end());
  return out;
}

/// Apart by the gap, within the material; measured anew.
void expectFeasible(const std::vector<NestPart>& parts, const NestMaterial& material,
                    const NestOptions& options, const Nesting& nesting) {
  for (std::size_t i = 0; i < nesting.places.size(); ++i) {
    const NestPlace& a = nesting.places[i];
    const Points2 line = cutLine(parts[a.part], a);
    EXPECT_GT(signedArea(line), 0);
    const Box2 box = boxOf(line);
    EXPECT_GE(box.min.minCoeff(), options.margin - 2e-3);
    EXPECT_LE(box.max.y(), material.width - options.margin + 2e-3);
    for (std::size_t j = 0; j < i; ++j) {
      const NestPlace& b = nesting.places[j];
      if (a.sheet != b.sheet) continue;
      EXPECT_GE(distanceBetween(line, cutLine(parts[b.part], b)), options.gap - 2e-3)
          << i << " and " << j;
    }
  }
}

Nesting nested(const std::vector<NestPart>& parts, const NestMaterial& material,
               const NestOptions& options) {
  const Result<Nesting> nesting = nest(parts, material, options);
  EXPECT_TRUE(nesting) << nesting.error();
  if (!nesting) return {};
  expectFeasible(parts, material, options, *nesting);
  return *nesting;
}

// Twelve squares of 100 on a roll that takes three of them side by side with their gaps; rows of
// 2.5 mm take the rest of its width.
TEST(Nest, PacksSquaresWithoutLoss) {
  const std::vector<NestPart> parts{rectangle(100, 100, 12)};
  const NestMaterial material{.width = 330};
  const Nesting nesting = nested(parts, material, {.gap = 10, .effort = 0});
  EXPECT_NEAR(nesting.length, 4 * 100 + 3 * 10, 1.5);
  EXPECT_NEAR(nesting.area, 12 * 1e4, 1e-6);
  EXPECT_NEAR(nesting.bound, 12 * 1e4 / 330, 1e-9);
  EXPECT_NEAR(nesting.utilisation, nesting.bound / nesting.length, 1e-12);
}

// Two triangles make a square when one may be turned upside down, and only then.
TEST(Nest, TurnsOnlyAsTheClothAllows) {
  NestPart triangle;
  triangle.name = "triangle";
  triangle.outline = {{0, 0}, {200, 0}, {0, 200}};
  triangle.count = 2;
  const NestMaterial material{.width = 215};
  triangle.turns = Turns::TwoWay;
  const Nesting turned = nested({triangle}, material, {.gap = 2, .effort = 2});
  EXPECT_LT(turned.length, 225);
  triangle.turns = Turns::OneWay;
  const Nesting oneWay = nested({triangle}, material, {.gap = 2, .effort = 2});
  EXPECT_GT(oneWay.length, 300);
  for (const NestPlace& place : oneWay.places) EXPECT_NEAR(place.placement.angle, 0, 1e-12);
}

TEST(Nest, LaysTheGrainAlongTheRoll) {
  NestPart part = rectangle(300, 50);
  part.grain = std::numbers::pi / 2;  // across the long side
  part.turns = Turns::OneWay;
  const Nesting nesting = nested({part}, {.width = 400}, {.gap = 0, .effort = 0});
  const Vector2d grain = nesting.places[0].placement.applyToDirection({0, 1});
  EXPECT_NEAR((grain - Vector2d(1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(nesting.length, 50, 0.5);
}

TEST(Nest, PairsAreMirrored) {
  NestPart shoe;
  shoe.name = "vamp";
  shoe.outline = {{0, 0}, {200, 0}, {180, 60}, {0, 100}};
  shoe.turns = Turns::OneWay;
  shoe.count = 2;
  shoe.mirrored = 2;
  const Nesting nesting = nested({shoe}, {.width = 300}, {.gap = 3, .effort = 3});
  const auto turnedOver = std::count_if(nesting.places.begin(), nesting.places.end(),
                                        [](const NestPlace& p) { return p.mirrored; });
  EXPECT_EQ(turnedOver, 2);
  // The grain of a copy turned over still runs along the roll.
  for (const NestPlace& place : nesting.places) {
    const Vector2d grain = place.apply({1, 0}) - place.apply({0, 0});
    EXPECT_NEAR(grain.x(), 1, 1e-12);
  }
}

TEST(Nest, HalvesLieOnTheFold) {
  NestPart half = rectangle(200, 90, 2);
  half.onFold = true;
  const Nesting nesting =
      nested({half, rectangle(150, 60, 3)}, {.width = 200}, {.gap = 4, .effort = 2});
  for (const NestPlace& place : nesting.places) {
    if (place.part != 0) continue;
    EXPECT_NEAR(place.apply({0, 0}).y(), 0, 0.2);
  }
}

TEST(Nest, FillsSheetAfterSheet) {
  const std::vector<NestPart> parts{rectangle(140, 90, 9)};
  const NestMaterial material{.width = 200, .length = 300.0};
  const Nesting nesting = nested(parts, material, {.gap = 5, .margin = 3, .effort = 1});
  EXPECT_EQ(nesting.sheets, 3U);
  std::array<int, 3> onSheet{};
  for (const NestPlace& place : nesting.places) ++onSheet[place.sheet];
  EXPECT_EQ(onSheet, (std::array<int, 3>{4, 4, 1}));
}

TEST(Nest, KeepsToTheHideAndOffItsFaults) {
  NestMaterial hide;
  for (int i = 0; i < 60; ++i) {
    const double a = 2 * std::numbers::pi * i / 60;
    const double r = 1 + 0.15 * std::cos(4 * a);
    hide.hide.emplace_back(1000 + 850 * r * std::cos(a), 700 + 550 * r * std::sin(a));
  }
  hide.faults.push_back({{900, 600}, {1100, 600}, {1100, 800}, {900, 800}});
  std::vector<NestPart> parts;
  for (unsigned s = 0; s < 12; ++s) {
    parts.push_back(blob(s, 150));
    parts.back().turns = Turns::Any;
    parts.back().count = 2;
  }
  const NestOptions options{.gap = 3, .effort = 1};
  const Result<Nesting> nesting = nest(parts, hide, options);
  ASSERT_TRUE(nesting) << nesting.error();
  for (const NestPlace& place : nesting->places) {
    const Points2 line = cutLine(parts[place.part], place);
    for (const Vector2d& p : line) EXPECT_TRUE(isInside({hide.hide}, p));
    EXPECT_GT(distanceBetween(line, hide.faults[0]), 0);
  }
  // More than the hide holds is refused.
  for (NestPart& part : parts) part.count = 20;
  const Result<Nesting> tooMuch = nest(parts, hide, {.gap = 3, .effort = 0});
  ASSERT_FALSE(tooMuch);
  EXPECT_EQ(tooMuch.error().code, ErrorCode::InvalidArgument);
}

TEST(Nest, IsTheSameForAnyNumberOfThreadsAndGetsBetterWithEffort) {
  std::vector<NestPart> parts;
  for (unsigned s = 0; s < 20; ++s) parts.push_back(blob(100 + s, 90 + 5.0 * s));
  const NestMaterial material{.width = 700};
  const Nesting first = nested(parts, material, {.gap = 5, .effort = 0});
  Nesting alone;
  {
    const ThreadLimit one(1);
    alone = nested(parts, material, {.gap = 5, .effort = 3});
  }
  const ThreadLimit three(3);
  const Nesting together = nested(parts, material, {.gap = 5, .effort = 3});
  ASSERT_EQ(alone.places.size(), together.places.size());
  for (std::size_t i = 0; i < alone.places.size(); ++i) {
    EXPECT_EQ(alone.places[i].placement.offset, together.places[i].placement.offset);
    EXPECT_EQ(alone.places[i].placement.angle, together.places[i].placement.angle);
  }
  EXPECT_LT(alone.length, first.length);
  EXPECT_GT(alone.length, alone.bound);
}

TEST(Nest, RefusesWhatCannotBeCut) {
  const auto refusal = [](const NestPart& part, const NestMaterial& material) {
    const std::vector<NestPart> parts{part};
    const Result<Nesting> nesting = nest(parts, material, {.gap = 5, .effort = 0});
    return nesting ? std::string() : nesting.error().message;
  };
  NestPart wide = rectangle(100, 1500);
  wide.name = "Rücken \"links\"";
  wide.turns = Turns::TwoWay;
  EXPECT_NE(refusal(wide, {.width = 1400}).find("\"Rücken \"links\"\" is 1500 mm wide"),
            std::string::npos);
  wide.turns = Turns::Any;  // laid along the roll it fits
  EXPECT_EQ(refusal(wide, {.width = 1400}), "");
  NestPart turnedOver = rectangle(10, 10);
  std::reverse(turnedOver.outline.begin(), turnedOver.outline.end());
  EXPECT_NE(refusal(turnedOver, {.width = 100}).find("no outline"), std::string::npos);
  EXPECT_NE(refusal(rectangle(10, 10, 0), {.width = 100}).find("nothing to nest"),
            std::string::npos);
  EXPECT_NE(refusal(rectangle(10, 10, -3), {.width = 100}).find("negative"), std::string::npos);
  EXPECT_NE(refusal(rectangle(10, 10), {.width = -1}).find("more than 0 mm"), std::string::npos);
  NestPart nowhere = rectangle(10, 10);
  nowhere.outline[1].x() = std::nan("");
  EXPECT_NE(refusal(nowhere, {.width = 100}).find("no outline"), std::string::npos);
  NestPart crossed = rectangle(10, 10);
  crossed.outline = {{0, 0}, {30, 0}, {30, 20}, {10, -5}, {0, 20}};
  EXPECT_NE(refusal(crossed, {.width = 100}).find("crosses itself at ("), std::string::npos);
}

// The rows cover the polygon: no point of it lies outside of its row's ranges.
TEST(RowShape, CoversThePolygon) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> at(-100, 100);
  const NestPart part = blob(5, 100);
  const nesting::RowShape shape = nesting::makeRowShape(part.outline, 7);
  const Box2 box = boxOf(part.outline);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector2d p(at(random), at(random));
    if (!isInside({part.outline}, p)) continue;
    ++inside;
    const Vector2d q = p - box.min;
    const auto ranges = shape.rows[static_cast<int>(q.y() / 7)];
    EXPECT_TRUE(std::any_of(ranges.begin(), ranges.end(),
                            [&](const ShiftRange& r) { return r.from <= q.x() && q.x() <= r.to; }));
  }
  EXPECT_GT(inside, 500);
}

}  // namespace
}  // namespace toile
