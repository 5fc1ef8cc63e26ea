// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/surface_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace toile {
namespace {

using Eigen::Vector3f;

float distanceToChain(const std::vector<Vector3f>& points, const Vector3f& p) {
  float best = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector3f axis = points[i + 1] - points[i];
    const float t = std::clamp(axis.dot(p - points[i]) / axis.squaredNorm(), 0.0F, 1.0F);
    best = std::min(best, (points[i] + t * axis - p).norm());
  }
  return best;
}

TEST(SurfaceLines, FindsTheNearestLineAsComparingAllDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-100, 100);
  const auto point = [&] { return Vector3f(place(random), place(random), place(random)); };
  constexpr LineRole kRoles[] = {LineRole::Seam, LineRole::Zip, LineRole::Feature};
  std::vector<SurfaceLine> lines;
  SurfaceLines index;
  for (std::uint32_t i = 0; i < 60; ++i) {
    SurfaceLine line;
    line.part = i % 2;
    line.role = kRoles[i % 3];
    line.points = {point()};
    for (int k = 0; k < 20; ++k) line.points.emplace_back(line.points.back() + 0.05F * point());
    lines.push_back(line);
    index.add(line);
  }
  constexpr float kReach = 9;
  index.prepare(kReach);
  int found = 0;
  for (int trial = 0; trial < 12000; ++trial) {
    const Vector3f p = point();
    const std::uint32_t part = static_cast<std::uint32_t>(trial) % 2;
    const SurfaceLines::Near near = index.near(part, p);
    for (const auto& [role, pass] : {std::pair(LineRole::Seam, near.border),
                                     {LineRole::Zip, near.zip},
                                     {LineRole::Feature, near.inside}}) {
      float best = kReach;
      for (const SurfaceLine& line : lines) {
        if (line.part == part && line.role == role) {
          best = std::min(best, distanceToChain(line.points, p));
        }
      }
      if (best >= kReach) {
        EXPECT_EQ(pass.line, nullptr);
        continue;
      }
      ++found;
      ASSERT_NE(pass.line, nullptr);
      EXPECT_NEAR(pass.across, best, 1e-3F);
    }
  }
  EXPECT_GT(found, 500);
}

TEST(SurfaceLines, MeasuresAlongTheLine) {
  SurfaceLines index;
  SurfaceLine line;
  line.points = {{0, 0, 0}, {10, 0, 0}, {10, 0, 20}};  // of every part
  index.add(line);
  index.prepare(3);
  const SurfaceLines::Near near = index.near(5, {11, 1, 8});
  ASSERT_NE(near.border.line, nullptr);
  EXPECT_FLOAT_EQ(near.border.along, 18);
  EXPECT_FLOAT_EQ(near.border.across, std::sqrt(2.0F));
  EXPECT_FLOAT_EQ(near.border.line->length, 30);
  EXPECT_EQ(index.near(5, {5, 3.5F, 0}).border.line, nullptr) << "out of reach";
  EXPECT_EQ(index.near(5, {500, 0, 0}).border.line, nullptr) << "outside of all boxes";
}

TEST(SurfaceLines, WithoutLinesNothingIsNear) {
  SurfaceLines index;
  index.prepare(3);
  EXPECT_EQ(index.near(0, {0, 0, 0}).border.line, nullptr);
}

}  // namespace
}  // namespace toile
