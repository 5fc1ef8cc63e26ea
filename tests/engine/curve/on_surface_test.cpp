// SPDX-License-Identifier: GPL-3.0-or-later
// Tracing, tracking, meetings and curvature of lines on a surface.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/surface_random.h"
#include "toile/curve/crossing.h"
#include "toile/curve/curvature.h"
#include "toile/curve/geodesic.h"
#include "toile/curve/trace.h"
#include "toile/curve/tracking.h"
#include "toile/mesh/surface_index.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

TEST(Trace, RunsStraightOverAFlatGrid) {
  const Mesh mesh = test::irregularGrid(20, 20);
  test::SurfaceRandom random(mesh, 3);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint from = random.point();
    const double angle = 2 * pi * random.number();
    const Vector3d direction(std::cos(angle), std::sin(angle), 0.3);
    const auto path = traceStraight(mesh, from, direction, 60);
    const Vector3d start = position(mesh, from);
    if (!path) {
      // Only where the direction leads over the border at once.
      EXPECT_TRUE(start.head<2>().minCoeff() < 1e-9 || start.head<2>().maxCoeff() > 200 - 1e-9);
      continue;
    }
    ASSERT_TRUE(isValid(mesh, *path));
    const double all = length(mesh, *path);
    const Vector3d end = position(mesh, path->points.back());
    const Vector3d flat = Vector3d(direction.x(), direction.y(), 0).normalized();
    EXPECT_LT((start + all * flat - end).norm(), 1e-9);
    if (all < 60 - 1e-9) {
      EXPECT_TRUE(end.head<2>().minCoeff() < 1e-6 || end.head<2>().maxCoeff() > 200 - 1e-6);
    }
  }
}

TEST(Trace, IsAGeodesicAndPassesVerticesWithEqualAngles) {
  const Mesh ball = test::icosphere(100, 3);
  test::SurfaceRandom random(ball, 5);
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint from{VertexId(random.below(ball.vertexCount()))};
    const Vector3d direction(random.number() - 0.5, random.number() - 0.5, random.number() - 0.5);
    const auto path = traceStraight(ball, from, direction, 150);
    ASSERT_TRUE(path);
    EXPECT_NEAR(length(ball, *path), 150, 1e-9);
    EXPECT_LT(geodesicDefect(ball, *path), 1e-6);
  }
  // Along mesh edges, through vertex after vertex.
  const Mesh grid = test::grid(10, 10);
  const auto path = traceStraight(grid, {VertexId(11 * 5)}, {1, 0, 0}, 100);
  ASSERT_TRUE(path);
  EXPECT_NEAR(length(grid, *path), 100, 1e-9);
}

TEST(Meetings, OfTwoLinesOnAGrid) {
  const auto mesh = std::make_shared<const Mesh>(test::irregularGrid(20, 20));
  const SurfaceIndex index(mesh);
  GeodesicLinker linker(mesh);
  const auto line = [&](double x0, double y0, double x1, double y1) {
    return *linker.link(index.closestPoint({x0, y0, 0}).point,
                        index.closestPoint({x1, y1, 0}).point);
  };
  const SurfacePath a = line(10, 95, 190, 115), b = line(60, 12, 130, 190);
  const auto meetings = findMeetings(*mesh, a, b);
  ASSERT_EQ(meetings.size(), 1U);
  EXPECT_LT((position(*mesh, meetings[0].point) -
             position(*mesh, pointAtFraction(*mesh, a, meetings[0].a / length(*mesh, a))))
                .norm(),
            1e-9);
  EXPECT_LT((position(*mesh, meetings[0].point) -
             position(*mesh, pointAtFraction(*mesh, b, meetings[0].b / length(*mesh, b))))
                .norm(),
            1e-9);
  EXPECT_TRUE(findMeetings(*mesh, a, line(10, 20, 190, 30)).empty());
  EXPECT_TRUE(findSelfMeetings(*mesh, a).empty());
  // A line that ends on a point of the other meets it there, exactly.
  const SurfacePoint middle = a.points[a.points.size() / 2];
  const auto touching =
      findMeetings(*mesh, a, *linker.link(middle, index.closestPoint({100, 10, 0}).point));
  ASSERT_EQ(touching.size(), 1U);
  EXPECT_EQ(touching[0].point, middle);
  EXPECT_EQ(touching[0].b, 0);
  // A figure of eight.
  std::vector<SurfacePoint> eight;
  for (int i = 0; i < 40; ++i) {
    const double t = 2 * pi * i / 40 + 0.1;
    eight.push_back(
        index.closestPoint({100 + 80 * std::sin(t), 100 + 60 * std::sin(2 * t), 0}).point);
  }
  EXPECT_EQ(findSelfMeetings(*mesh, *linker.linkAll(eight, true)).size(), 1U);
}

// A segment without length lies on one line with everything, but does not meet it for that.
TEST(Meetings, SegmentsWithoutLengthMeetNothingElse) {
  const Mesh mesh = test::icosphere(100, 1);
  const FaceId face(5);
  const auto at = [&](double a, double b, double c) {
    return makeSurfacePoint(mesh, face, {a, b, c});
  };
  const SurfacePath line{{at(6, 1, 1), at(1, 6, 1)}, {face}};
  const SurfacePath still{{at(1, 1, 4), at(1, 1, 4), at(1, 2, 8)}, {face, face}};
  EXPECT_TRUE(findMeetings(mesh, line, still).empty());
  EXPECT_TRUE(findMeetings(mesh, still, line).empty());
  const SurfacePath on{{at(3, 3, 1), at(3, 3, 1), at(1, 1, 4)}, {face, face}};
  const SurfacePath through{{at(3, 3, 1), at(6, 1, 1)}, {face}};
  EXPECT_EQ(findMeetings(mesh, through, on).size(), 1U);
}

// A segment along an edge is in both faces of the edge, whichever of them it names.
TEST(Meetings, OfASegmentAlongAnEdgeAreInBothFaces) {
  const Mesh mesh = test::icosphere(100, 1);
  const EdgeId edge(7);
  const HalfedgeId h = mesh.halfedge(edge);
  const FaceId faces[]{mesh.face(h), mesh.face(mesh.opposite(h))};
  const auto on = [&](double t) { return SurfacePoint{SurfacePoint::OnEdge{edge, t}}; };
  for (const FaceId beside : faces) {
    // Ends inside the face, on the edge but for rounding.
    const double hair = 1e-14;
    Eigen::Vector3d weights = 0.6 * barycentricIn(mesh, on(0.4), beside);
    weights += 0.4 * barycentricIn(mesh, on(0.9), beside);
    for (int k = 0; k < 3; ++k) weights[k] = std::max(weights[k], hair);
    const SurfacePoint nearEdge{SurfacePoint::InFace{beside, weights / weights.sum()}};
    const SurfacePath ending{{makeSurfacePoint(mesh, beside, {1, 1, 1}), nearEdge}, {beside}};
    for (const FaceId named : faces) {
      const SurfacePath along{{on(0.3), on(0.8)}, {named}};
      EXPECT_EQ(findMeetings(mesh, along, ending).size(), 1U);
      EXPECT_EQ(findMeetings(mesh, ending, along).size(), 1U);
    }
  }
}

TEST(Curvature, OfCirclesOnAPlaneAndABall) {
  const auto plane = std::make_shared<const Mesh>(test::irregularGrid(40, 40, 5));
  const SurfaceIndex index(plane);
  GeodesicLinker linker(plane);
  std::vector<SurfacePoint> ring;
  for (int i = 0; i < 60; ++i) {
    const double t = 2 * pi * i / 60;
    ring.push_back(index.closestPoint({100 + 70 * std::cos(t), 100 + 70 * std::sin(t), 0}).point);
  }
  for (const CurvatureSample& s : sampleCurvature(*plane, *linker.linkAll(ring, true), 60)) {
    EXPECT_NEAR(s.curvature, 1.0 / 70, 2e-3);  // counter-clockwise: to the left
  }
  // A parallel of a ball at latitude b turns by tan(b) / R, whatever the ball bends.
  const auto ball = std::make_shared<const Mesh>(test::icosphere(100, 5));
  const SurfaceIndex ballIndex(ball);
  GeodesicLinker ballLinker(ball);
  const double b = 0.6;
  std::vector<SurfacePoint> parallel;
  for (int i = 0; i < 60; ++i) {
    const double t = 2 * pi * i / 60;
    parallel.push_back(ballIndex
                           .closestPoint(100 * Vector3d(std::cos(b) * std::cos(t),
                                                        std::cos(b) * std::sin(t), std::sin(b)))
                           .point);
  }
  double mean = 0;
  for (const CurvatureSample& s : sampleCurvature(*ball, *ballLinker.linkAll(parallel, true), 60)) {
    mean += s.curvature / 60;
  }
  EXPECT_NEAR(mean, std::tan(b) / 100, 2e-4);
}

TEST(Tracker, StaysOnItsLegWhileTheCursorPassesOverTheOther) {
  const auto mesh = std::make_shared<const Mesh>(test::trousers(24, 20));
  const SurfaceIndex index(mesh);
  const double low = mesh->boxMin().z() + 0.2 * (mesh->boxMax().z() - mesh->boxMin().z());
  const double wide = mesh->boxMax().x();
  const SurfacePoint start = index.closestPoint({0.5 * wide, -1000, low}).point;
  ASSERT_GT(position(*mesh, start).x(), 0);
  SurfaceTracker tracker(mesh, start);
  // Straight across to the other leg and on: the point stays on its own.
  for (int i = 0; i <= 40; ++i) {
    tracker.moveTo({0.5 * wide - 1.2 * wide * i / 40, -40, low});
    EXPECT_GT(position(*mesh, tracker.at()).x(), 0) << i;
  }
  // In one jump of the mouse as well.
  tracker.restart(start);
  EXPECT_GT(position(*mesh, tracker.moveTo({-0.7 * wide, -40, low})).x(), 0);
  tracker.restart(start);
  const Ray ray{{-0.5 * wide, -2000, low}, {0, 1, 0}};
  EXPECT_GT(position(*mesh, tracker.moveUnder(ray)).x(), 0);
  // Where the surface leads over there, it goes: up, across, down.
  tracker.restart(start);
  const double high = mesh->boxMax().z() - 5;
  tracker.moveTo({0.5 * wide, -60, high});
  tracker.moveTo({-0.5 * wide, -60, high});
  tracker.moveTo({-0.5 * wide, -60, low});
  EXPECT_LT(position(*mesh, tracker.at()).x(), 0);
}

TEST(Tracker, LiesUnderTheCursorOnItsSide) {
  const auto mesh = std::make_shared<const Mesh>(test::icosphere(100, 4));
  const SurfaceIndex index(mesh);
  for (const double side : {-1.0, 1.0}) {
    SurfaceTracker tracker(mesh, index.closestPoint({0, 100 * side, 0}).point);
    for (const double x : {10.0, 40.0, -60.0, 0.0, 85.0}) {
      const Vector3d p = position(*mesh, tracker.moveUnder({{x, -1000, 20}, {0, 1, 0}}));
      EXPECT_NEAR(p.x(), x, 1e-3);
      EXPECT_NEAR(p.z(), 20, 1e-3);
      EXPECT_GT(p.y() * side, 0);
    }
    // Beyond the outline it stays on it.
    const Vector3d p = position(*mesh, tracker.moveUnder({{150, -1000, 20}, {0, 1, 0}}));
    EXPECT_NEAR(std::hypot(p.x(), p.z()), 100, 1.5);
  }
}

TEST(Tracker, TheAnswerDoesNotDependOnHowOftenTheMouseIsAsked) {
  const auto mesh = std::make_shared<const Mesh>(test::saddle(60, 5, 0.005));
  const SurfaceIndex index(mesh);
  const SurfacePoint start = index.closestPoint({100, 100, 0}).point;
  SurfaceTracker often(mesh, start), once(mesh, start);
  const Vector3d from = position(*mesh, start), to = from + Vector3d(60, 30, 20);
  for (int i = 1; i <= 50; ++i) often.moveTo(from + (to - from) * (i / 50.0));
  once.moveTo(to);
  EXPECT_LT((position(*mesh, often.at()) - position(*mesh, once.at())).norm(), 1e-6);
}

}  // namespace
}  // namespace toile
