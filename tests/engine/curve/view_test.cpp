// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/meshes.h"
#include "support/result_printing.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

SurfaceIndex indexOf(Mesh mesh) {
  return SurfaceIndex(std::make_shared<const Mesh>(std::move(mesh)));
}

/// Two balls of radius 50 at x = -60 and x = 60; one component each.
Mesh twoBalls() {
  const Mesh one = test::icosphere(50, 3);
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  for (const double x : {-60.0, 60.0}) {
    const std::size_t first = positions.size();
    for (const Vector3d& p : one.positions()) positions.push_back(p + Vector3d(x, 0, 0));
    for (const auto& [a, b, c] : one.triangles()) {
      triangles.push_back(
          {VertexId(a.index() + first), VertexId(b.index() + first), VertexId(c.index() + first)});
    }
  }
  Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  EXPECT_TRUE(mesh);
  return *std::move(mesh);
}

TEST(View, RaysPassThroughThePointsOfItsPlane) {
  const View front{{0, -2000, 500}, {0, 0, 500}, {0, 0, 1}, 1000, true};
  const Ray ray = rayThrough(front, {100, 40});
  // Seen from the front the screen's right is +x and its top +z.
  const double t = -ray.origin.y() / ray.direction.y();
  EXPECT_LT((ray.origin + t * ray.direction - Vector3d(100, 0, 540)).norm(), 1e-9);
  EXPECT_EQ(ray.origin, front.eye);

  View parallel = front;
  parallel.perspective = false;
  const Ray straight = rayThrough(parallel, {100, 40});
  EXPECT_LT((straight.direction - Vector3d(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((straight.origin - Vector3d(100, -2000, 540)).norm(), 1e-9);

  // Straight from above, where `up` does not say which way the screen is turned.
  const View above{{0, 0, 3000}, {0, 0, 0}, {0, 0, 1}, 1000, true};
  EXPECT_TRUE(rayThrough(above, {10, 0}).direction.allFinite());
}

TEST(View, ProjectsOntoTheNearSide) {
  const SurfaceIndex index = indexOf(test::icosphere(100, 4));
  const View front{{0, -1000, 0}, {0, 0, 0}, {0, 0, 1}, 300, false};
  const std::vector<Vector2d> drawn{{-60, 0}, {-30, 20}, {0, 30}, {40, 10}};
  const auto points = projectFromView(index, front, drawn);
  ASSERT_TRUE(points) << points.error();
  ASSERT_EQ(points->size(), drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Vector3d p = position(index.mesh(), (*points)[i]);
    EXPECT_NEAR(p.x(), drawn[i].x(), 1e-9);
    EXPECT_NEAR(p.z(), drawn[i].y(), 1e-9);
    EXPECT_LT(p.y(), 0);
  }
}

TEST(View, RefusesWhatLeavesTheOutline) {
  const SurfaceIndex index = indexOf(test::icosphere(100, 3));
  const View front{{0, -1000, 0}, {0, 0, 0}, {0, 0, 1}, 300, true};
  const auto points =
      projectFromView(index, front, std::vector<Vector2d>{{0, 0}, {80, 0}, {140, 0}, {170, 0}});
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().code, ErrorCode::LeavesSilhouette);
  EXPECT_NE(points.error().message.find("2 of 4"), std::string::npos) << points.error().message;
}

TEST(View, RefusesAJumpToAnotherPart) {
  const SurfaceIndex balls = indexOf(twoBalls());
  const View front{{0, -1000, 0}, {0, 0, 0}, {0, 0, 1}, 300, true};
  const auto apart = projectFromView(balls, front, std::vector<Vector2d>{{-40, 0}, {40, 0}});
  ASSERT_FALSE(apart);
  EXPECT_EQ(apart.error().code, ErrorCode::CurveInvalid);

  // From one leg to the other: connected, but far around over the surface.
  const SurfaceIndex legs = indexOf(test::trousers());
  const View level{{0, -3000, 100}, {0, 0, 100}, {0, 0, 1}, 800, false};
  const auto jump = projectFromView(legs, level, std::vector<Vector2d>{{-70, 0}, {70, 0}});
  ASSERT_FALSE(jump);
  EXPECT_EQ(jump.error().code, ErrorCode::CurveInvalid);
  const auto along = projectFromView(legs, level, std::vector<Vector2d>{{80, -50}, {90, 50}});
  EXPECT_TRUE(along);
}

}  // namespace
}  // namespace toile
