// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/surface_index.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "mesh/triangle_queries.h"
#include "support/meshes.h"

namespace toile {
namespace {

SurfaceIndex indexOf(Mesh mesh) {
  return SurfaceIndex(std::make_shared<const Mesh>(std::move(mesh)));
}

double bruteForceDistance(const Mesh& mesh, const Eigen::Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles()) {
    const Eigen::Vector3d w =
        detail::closestWeights(p, mesh.position(a), mesh.position(b), mesh.position(c));
    const Eigen::Vector3d q =
        w[0] * mesh.position(a) + w[1] * mesh.position(b) + w[2] * mesh.position(c);
    best = std::min(best, (p - q).norm());
  }
  return best;
}

TEST(ClosestWeights, AgreeWithAFineSearchOverTheTriangle) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const auto point = [&] {
    return Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d a = point();
    const Eigen::Vector3d b = point();
    // Every fifth triangle has no area.
    const Eigen::Vector3d c = trial % 5 == 0 ? Eigen::Vector3d(0.3 * a + 0.7 * b) : point();
    const Eigen::Vector3d p = point();
    const Eigen::Vector3d w = detail::closestWeights(p, a, b, c);
    ASSERT_GE(w.minCoeff(), 0);
    ASSERT_NEAR(w.sum(), 1, 1e-15);
    const double distance = (p - (w[0] * a + w[1] * b + w[2] * c)).norm();
    const int n = 60;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Eigen::Vector3d q = (i * a + j * b + (n - i - j) * c) / n;
        ASSERT_LE(distance, (p - q).norm() + 1e-12) << "trial " << trial;
      }
    }
  }
}

TEST(SurfaceIndex, ClosestPointIsTheNearestOfAllFaces) {
  const SurfaceIndex index = indexOf(test::torus(100, 40, 24, 16));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-200, 200);
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
    const ClosestPoint closest = index.closestPoint(p);
    ASSERT_TRUE(isValid(index.mesh(), closest.point));
    EXPECT_NEAR(closest.distance, bruteForceDistance(index.mesh(), p), 1e-12);
    EXPECT_EQ(closest.position, position(index.mesh(), closest.point));
  }
}

TEST(SurfaceIndex, ClosestPointToAVertexOrEdgeIsThatVertexOrEdge) {
  const SurfaceIndex index = indexOf(test::icosphere(100, 2));
  const Mesh& mesh = index.mesh();
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const ClosestPoint closest = index.closestPoint(1.1 * mesh.position(VertexId(v)));
    EXPECT_EQ(closest.point, SurfacePoint{VertexId(v)});
  }
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const EdgeId edge(e);
    const Eigen::Vector3d middle =
        0.5 * (mesh.position(mesh.tail(edge)) + mesh.position(mesh.head(edge)));
    const ClosestPoint closest = index.closestPoint(1.1 * middle);
    const auto* on = std::get_if<SurfacePoint::OnEdge>(&closest.point.at);
    ASSERT_NE(on, nullptr) << e;
    EXPECT_EQ(on->edge, edge);
    EXPECT_NEAR(on->t, 0.5, 1e-12);
  }
}

TEST(SurfaceIndex, RayThroughATorusMeetsItFourTimes) {
  const SurfaceIndex index = indexOf(test::torus(100, 40, 96, 64));
  const std::vector<RayHit> hits = index.rayHits({-500, 1.5, 2.5}, {2, 0, 0});
  ASSERT_EQ(hits.size(), 4U);
  const std::array<double, 4> expected = {-140, -60, 60, 140};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(hits[i].position.x(), expected[i], 0.5);
    EXPECT_NEAR(hits[i].t, (hits[i].position.x() + 500) / 2, 1e-12);
    EXPECT_EQ(hits[i].facesOrigin, i % 2 == 0);
    EXPECT_NEAR(hits[i].position.y(), 1.5, 1e-12);
  }
  EXPECT_TRUE(index.rayHits({500, 1.5, 2.5}, {1, 0, 0}).empty()) << "the torus is behind";
  EXPECT_TRUE(index.rayHits({0, 0, 0}, {0, 0, 0}).empty());
}

// From the hole of the torus the inside of the tube is hidden behind its outside.
TEST(SurfaceIndex, FirstVisibleHitPassesFacesSeenFromBehind) {
  const SurfaceIndex index = indexOf(test::torus(100, 40, 96, 64));
  const auto inTube = index.firstVisibleHit({-100, 1.5, 2.5}, {1, 0, 0});
  ASSERT_TRUE(inTube);
  EXPECT_NEAR(inTube->position.x(), 60, 0.5);
  EXPECT_FALSE(index.firstVisibleHit({100, 1.5, 2.5}, {1, 0, 0}));
}

// Through vertices and edges a ray meets many faces at once: one hit, and never none.
TEST(SurfaceIndex, RaysThroughVerticesAndEdgesHitOnce) {
  const SurfaceIndex index = indexOf(test::icosphere(100, 3));
  const Mesh& mesh = index.mesh();
  const Eigen::Vector3d from(13, 7, 3);  // inside
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    EXPECT_EQ(index.rayHits(from, mesh.position(VertexId(v)) - from).size(), 1U) << "vertex " << v;
  }
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const EdgeId edge(e);
    const Eigen::Vector3d on =
        0.3 * mesh.position(mesh.tail(edge)) + 0.7 * mesh.position(mesh.head(edge));
    const std::vector<RayHit> hits = index.rayHits(from, on - from);
    ASSERT_EQ(hits.size(), 1U) << "edge " << e;
    EXPECT_LT((hits[0].position - on).norm(), 1e-9);
  }
}

TEST(SurfaceIndex, AnyRayFromWithinAClosedSurfaceLeavesIt) {
  const SurfaceIndex index = indexOf(test::cube(100, 8));
  std::mt19937 random(3);
  std::uniform_int_distribution<int> whole(-8, 8);
  int trials = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d direction(whole(random), whole(random), whole(random));
    if (direction.isZero(0)) continue;
    ++trials;
    EXPECT_EQ(index.rayHits({50, 50, 50}, direction).size(), 1U) << direction.transpose();
  }
  EXPECT_GT(trials, 4000);
}

double expectPath(const Mesh& mesh, const SurfacePath& path, const Eigen::Vector3d& normal,
                  double offset) {
  EXPECT_TRUE(isValid(mesh, path));
  for (const SurfacePoint& point : path.points) {
    EXPECT_NEAR(normal.dot(position(mesh, point)), offset, 1e-9);
  }
  return length(mesh, path);
}

TEST(PlaneSection, OfACylinderIsItsPolygonAtAnyHeight) {
  const int segments = 24;
  const SurfaceIndex index = indexOf(test::cylinder(50, 300, segments, 6));
  const double girth = 2 * 50 * segments * std::sin(std::numbers::pi / segments);
  // 100 is the height of a row of vertices: the section runs along edges.
  for (const double height : {17.0, 100.0, 150.0, 299.0}) {
    const auto paths = index.planeSection({0, 0, 1}, height);
    ASSERT_EQ(paths.size(), 1U) << height;
    EXPECT_TRUE(paths[0].closed);
    EXPECT_NEAR(expectPath(index.mesh(), paths[0], {0, 0, 1}, height), girth, 1e-9);
  }
  EXPECT_TRUE(index.planeSection({0, 0, 1}, 301).empty());
  EXPECT_TRUE(index.planeSection({0, 0, 1}, -1).empty());
}

TEST(PlaneSection, RunsWithTheUpperSideOnItsLeft) {
  const SurfaceIndex index = indexOf(test::cylinder(50, 300, 24, 6));
  const auto paths = index.planeSection({0, 0, 1}, 130);
  ASSERT_EQ(paths.size(), 1U);
  double area = 0;
  for (std::size_t i = 0; i < paths[0].points.size(); ++i) {
    const Eigen::Vector3d a = position(index.mesh(), paths[0].points[i]);
    const Eigen::Vector3d b =
        position(index.mesh(), paths[0].points[(i + 1) % paths[0].points.size()]);
    area += 0.5 * a.cross(b).z();
  }
  EXPECT_GT(area, 0) << "counter-clockwise seen from above";
}

TEST(PlaneSection, OfAnOpenSurfaceEndsAtItsBorder) {
  const SurfaceIndex index = indexOf(test::cylinder(50, 300, 24, 6));
  // Through the axis, and through two lines of vertices.
  const auto paths = index.planeSection({0, 1, 0}, 0);
  ASSERT_EQ(paths.size(), 2U);
  for (const SurfacePath& path : paths) {
    EXPECT_FALSE(path.closed);
    EXPECT_NEAR(expectPath(index.mesh(), path, {0, 1, 0}, 0), 300, 1e-9);
  }
}

TEST(PlaneSection, PathsAreSortedByLength) {
  const SurfaceIndex index = indexOf(test::torus(100, 40, 96, 64));
  const auto paths = index.planeSection({0, 0, 2}, 4.0);  // z = 2; the normal needs no unit length
  ASSERT_EQ(paths.size(), 2U);
  const double outer = expectPath(index.mesh(), paths[0], {0, 0, 2}, 4);
  const double inner = expectPath(index.mesh(), paths[1], {0, 0, 2}, 4);
  EXPECT_NEAR(outer, 2 * std::numbers::pi * 140, 2);
  EXPECT_NEAR(inner, 2 * std::numbers::pi * 60, 2);
}

TEST(PlaneSection, OfFacesInThePlaneIsTheirOutlineFromBelow) {
  const SurfaceIndex index = indexOf(test::cube(100, 4));
  const auto top = index.planeSection({0, 0, 1}, 100);
  ASSERT_EQ(top.size(), 1U);
  EXPECT_TRUE(top[0].closed);
  EXPECT_NEAR(expectPath(index.mesh(), top[0], {0, 0, 1}, 100), 400, 1e-9);
  EXPECT_TRUE(index.planeSection({0, 0, 1}, 0).empty());
}

// A roof whose ridge, or a cone whose tip, only touches the plane from below has no section there.
TEST(PlaneSection, TouchingFromBelowIsNoSection) {
  const SurfaceIndex roof =
      indexOf(test::heightField(8, 4, 10, [](double x, double) { return 40 - std::abs(x - 40); }));
  EXPECT_TRUE(roof.planeSection({0, 0, 1}, 40).empty());
  EXPECT_EQ(roof.planeSection({0, 0, 1}, 35).size(), 2U);
  const SurfaceIndex sphere = indexOf(test::icosphere(100, 2));
  EXPECT_TRUE(sphere.planeSection({0, 0, 1}, sphere.mesh().boxMax().z()).empty());
}

TEST(PlaneSection, RandomPlanesCutClosedSurfacesInClosedPaths) {
  const SurfaceIndex index = indexOf(test::icosphere(100, 3));
  std::mt19937 random(4);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(-95, 95);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d normal =
        Eigen::Vector3d(gauss(random), gauss(random), gauss(random)).normalized();
    const double offset = uniform(random);
    const auto paths = index.planeSection(normal, offset);
    ASSERT_EQ(paths.size(), 1U);
    EXPECT_TRUE(paths[0].closed);
    const double radius = std::sqrt(100.0 * 100.0 - offset * offset);
    const double length = expectPath(index.mesh(), paths[0], normal, offset);
    EXPECT_LT(length, 2 * std::numbers::pi * radius);
    EXPECT_GT(length, 2 * std::numbers::pi * radius - 20);
  }
}

}  // namespace
}  // namespace toile
