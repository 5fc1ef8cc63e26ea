// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/studio_light.h"

#include <gtest/gtest.h>

#include <bit>

#include "render/ground_shadow.h"

namespace toile {
namespace {

using Eigen::Vector3f;

/// A level square plate of that half width.
RayScene plate(float half, float height) {
  const std::vector<Vector3f> points = {
      {-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}};
  const std::vector<std::uint32_t> corners = {0, 1, 2, 0, 2, 3};
  return RayScene::ofTriangles(points, corners);
}

std::vector<Vector3f> lightFromEverywhere(const SkyView& sky) {
  return std::vector<Vector3f>(sky.directions.size(), Vector3f::Ones());
}

TEST(StudioLight, AnOpenSurfaceGetsAllOfEvenLight) {
  const std::vector<Vector3f> points = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const std::vector<Vector3f> normals = {Vector3f::UnitZ(), Vector3f::UnitX(),
                                         Vector3f(1, 2, -2) / 3};
  const SkyView sky = computeSkyView(RayScene(), points, normals, 0, 1000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // 1 is the exact integral; grazing directions are left out, and 128 are a coarse sum.
    EXPECT_NEAR(irradiance(sky, i, lightFromEverywhere(sky), normals[i]).x(), 1, 0.02);
  }
}

TEST(StudioLight, APlateAboveTakesItsShareAway) {
  // The cosine-weighted share of a square of half width a at height h is known: 4 / pi * (a / r)
  // atan(a / r), r = sqrt(a^2 + h^2), for a point below its middle.
  const std::vector<Vector3f> points = {{0, 0, 0}};
  const std::vector<Vector3f> normals = {Vector3f::UnitZ()};
  for (const float half : {0.5F, 1.0F, 3.0F}) {
    const RayScene scene = plate(half, 1);
    const SkyView sky = computeSkyView(scene, points, normals, 0, 1000);
    const float r = std::sqrt(half * half + 1);
    const float covered = 4 / 3.14159265F * half / r * std::atan(half / r);
    EXPECT_NEAR(irradiance(sky, 0, lightFromEverywhere(sky), normals[0]).x(), 1 - covered, 0.04)
        << half;
    // Out of reach it takes none.
    const SkyView near = computeSkyView(scene, points, normals, 0, 0.5F);
    EXPECT_EQ(near.open[0], SkyView::kAllOpen);
  }
}

TEST(StudioLight, ComesFromTheLampAndFollowsTheCamera) {
  SkyView sky;
  const std::vector<Vector3f> points = {{0, 0, 0}};
  const std::vector<Vector3f> normals = {Vector3f::UnitZ()};
  sky = computeSkyView(RayScene(), points, normals, 0, 1);
  const auto lightOf = [&](const Vector3f& right, const Vector3f& eye, const Vector3f& normal) {
    return openIrradiance(sky, studioLight(sky.directions, right, Vector3f::UnitZ(), eye), normal)
        .mean();
  };
  const Vector3f x = Vector3f::UnitX();
  const Vector3f y = Vector3f::UnitY();
  // Seen from -y the lamp is at -x, high, in front.
  const Vector3f lit = Vector3f(-1, -1, 1).normalized();
  EXPECT_GT(lightOf(x, -y, lit), 1);
  EXPECT_GT(lightOf(x, -y, lit), 2.5F * lightOf(x, -y, Vector3f(1, -1, -1).normalized()));
  // From behind it is the same the other way round.
  const Vector3f turned(-lit.x(), -lit.y(), lit.z());
  EXPECT_NEAR(lightOf(-x, y, turned), lightOf(x, -y, lit), 0.05);
}

TEST(GroundShadow, IsDarkBelowAndGoneFarAway) {
  const RayScene scene = plate(100, 50);
  const GroundShadow shadow(scene, {-100, -100, 0}, {100, 100, 50});
  const std::vector<float> darkness = shadow.darkness(studioLight(
      shadow.sky().directions, Vector3f::UnitX(), Vector3f::UnitZ(), -Vector3f::UnitY()));
  const auto at = [&](float x, float y) {
    return shadow.at(darkness, {x, y, 500}, -Vector3f::UnitZ());
  };
  EXPECT_GT(at(0, 0), 0.6F);
  EXPECT_LE(at(0, 0), 1.0F);
  EXPECT_LT(at(-155, 0), 0.25F);
  EXPECT_EQ(at(1000, 0), 0);
  EXPECT_EQ(shadow.at(darkness, {0, 0, 500}, Vector3f::UnitZ()), 0) << "a ray to the sky";
}

}  // namespace
}  // namespace toile
