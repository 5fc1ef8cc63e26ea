// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/fairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/curve/crossing.h"
#include "toile/curve/curvature.h"
#include "toile/mesh/surface_index.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

struct Ground {
  explicit Ground(Mesh m)
      : mesh(std::make_shared<const Mesh>(std::move(m))), index(mesh), linker(mesh) {}
  SurfacePath line(const std::function<Vector3d(double)>& place, int count, bool closed = false) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < count + (closed ? 0 : 1); ++i) {
      points.push_back(index.closestPoint(place(static_cast<double>(i) / count)).point);
    }
    return *linker.linkAll(points, closed);
  }
  std::shared_ptr<const Mesh> mesh;
  SurfaceIndex index;
  GeodesicLinker linker;
};

/// An ellipsoid 200 x 140 x 100 in half axes.
Ground ellipsoid() {
  Eigen::Matrix3d scale = Vector3d(200, 140, 100).asDiagonal();
  return Ground(test::transformed(test::icosphere(1, 4), scale, Vector3d::Zero()));
}
/// Over its top from one side to the other, with an S of the given amplitude in the middle.
Vector3d overTop(double t, double amplitude) {
  const double a = -1.2 + 2.4 * t;
  const double bump = amplitude * std::sin(6 * pi * t) * std::exp(-std::pow((t - 0.5) / 0.15, 2));
  return {200 * std::sin(a), 30 * std::cos(a) + bump, 100 * std::cos(a)};
}

double farthest(Ground& ground, const SurfacePath& from, const SurfacePath& to) {
  double worst = 0;
  for (int i = 0; i <= 100; ++i) {
    const Vector3d p = position(*ground.mesh, pointAtFraction(*ground.mesh, from, i / 100.0));
    worst = std::max(worst, nearestOnPath(*ground.mesh, to, p).distance);
  }
  return worst;
}

// The article's figure 12: a line that a transfer has disturbed.
TEST(Fairing, TakesAnSOutOfALineAndKeepsItsShape) {
  Ground ground = ellipsoid();
  const SurfacePath plain = ground.line([](double t) { return overTop(t, 0); }, 60);
  const SurfacePath disturbed = ground.line([](double t) { return overTop(t, 15); }, 60);
  const int wanted =
      measureRestlessness(sampleCurvature(*ground.mesh, plain, 80), false).inflections;
  FairNetwork network;
  network.lines.push_back({disturbed, {}, FairEnd::Clamped, FairEnd::Clamped, false, wanted});
  const auto faired = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_TRUE(faired) << faired.error();
  const FairedLine& line = faired->lines[0];
  EXPECT_TRUE(isValid(*ground.mesh, line.path));
  EXPECT_GE(line.inflectionsBefore, wanted + 3);
  EXPECT_LE(line.inflectionsAfter, wanted);
  EXPECT_LT(line.variationAfter, 0.2 * line.variationBefore);
  EXPECT_LT(farthest(ground, line.path, plain), 0.35 * farthest(ground, disturbed, plain));
  // Its ends stay, and so does their direction.
  EXPECT_EQ(line.path.points.front(), disturbed.points.front());
  EXPECT_EQ(line.path.points.back(), disturbed.points.back());

  // Without knowing what is wanted it finds the same.
  network.lines[0].inflections.reset();
  const auto alone = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_TRUE(alone) << alone.error();
  EXPECT_LT(alone->lines[0].inflectionsAfter, line.inflectionsBefore);
  EXPECT_LT(alone->lines[0].variationAfter, 0.3 * line.variationBefore);
}

TEST(Fairing, LeavesAGeodesicAlone) {
  Ground ground(test::closedCylinder(60, 300, 48, 40));
  const SurfacePath helix = ground.line(
      [](double t) { return Vector3d(60 * std::cos(3 * t), 60 * std::sin(3 * t), 40 + 200 * t); },
      60);
  FairNetwork network;
  network.lines.push_back({helix, {}, FairEnd::Clamped, FairEnd::Clamped, false, std::nullopt});
  const auto faired = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_TRUE(faired) << faired.error();
  EXPECT_LT(faired->lines[0].deviation.mm(), 0.5);
}

TEST(Fairing, LinesThatShareANodeStillDo) {
  Ground ground = ellipsoid();
  const SurfacePath a = ground.line([](double t) { return overTop(t, 12); }, 60);
  const SurfacePath b = ground.line(
      [](double t) {
        const double angle = -1.1 + 2.2 * t;
        return Vector3d(20 + 8 * std::sin(30 * t), 140 * std::sin(angle), 100 * std::cos(angle));
      },
      60);
  const auto meetings = findMeetings(*ground.mesh, a, b);
  ASSERT_EQ(meetings.size(), 1U);
  FairNetwork network;
  network.nodes.push_back({meetings[0].point, false});
  network.lines.push_back({a, {{meetings[0].a, 0}}, FairEnd::Clamped, FairEnd::Clamped, false, {}});
  network.lines.push_back({b, {{meetings[0].b, 0}}, FairEnd::Pinned, FairEnd::Pinned, false, {}});
  const auto faired = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_TRUE(faired) << faired.error();
  EXPECT_FALSE(faired->nodes[0] == meetings[0].point);
  for (const FairedLine& line : faired->lines) {
    EXPECT_TRUE(isValid(*ground.mesh, line.path));
    EXPECT_EQ(std::count(line.points.begin(), line.points.end(), faired->nodes[0]), 1);
    EXPECT_LT(line.variationAfter, 0.6 * line.variationBefore);
  }
  // A node that is held does not move; a line that is held neither.
  network.nodes[0].isFixed = true;
  network.lines[0].isFixed = true;
  const auto held = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_TRUE(held) << held.error();
  EXPECT_EQ(held->nodes[0], meetings[0].point);
  EXPECT_EQ(held->lines[0].path.points, a.points);
}

TEST(Fairing, OfAClosedLine) {
  Ground ground = ellipsoid();
  const auto ring = [](double wave) {
    return [wave](double t) {
      const double a = 2 * pi * t;
      return Vector3d(120 * std::cos(a), 84 * std::sin(a), 80 + wave * std::sin(11 * a));
    };
  };
  const SurfacePath plain = ground.line(ring(0), 80, true);
  const SurfacePath disturbed = ground.line(ring(5), 80, true);
  FairNetwork network;
  network.lines.push_back({disturbed, {}, FairEnd::Clamped, FairEnd::Clamped, false, 0});
  const auto faired = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_TRUE(faired) << faired.error();
  EXPECT_GE(faired->lines[0].inflectionsBefore, 10);
  EXPECT_EQ(faired->lines[0].inflectionsAfter, 0);
  EXPECT_LT(farthest(ground, faired->lines[0].path, plain), 2.5);
}

TEST(Fairing, HoldsToTheDeviationThatIsAllowed) {
  Ground ground = ellipsoid();
  FairNetwork network;
  network.lines.push_back({ground.line([](double t) { return overTop(t, 15); }, 60),
                           {},
                           FairEnd::Clamped,
                           FairEnd::Clamped,
                           false,
                           0});
  FairingOptions options;
  options.maxDeviation = Length::mm(3);
  const auto faired = fairNetwork(ground.linker, ground.mesh, network, options);
  ASSERT_TRUE(faired) << faired.error();
  EXPECT_LE(faired->lines[0].deviation.mm(), 3);
  EXPECT_GT(faired->lines[0].deviation.mm(), 0);
}

TEST(Fairing, RefusesWhatIsFixedEverywhere) {
  Ground ground = ellipsoid();
  FairNetwork network;
  network.lines.push_back({ground.line([](double t) { return overTop(t, 15); }, 60),
                           {},
                           FairEnd::Clamped,
                           FairEnd::Clamped,
                           true,
                           {}});
  const auto faired = fairNetwork(ground.linker, ground.mesh, network);
  ASSERT_FALSE(faired);
  EXPECT_EQ(faired.error().code, ErrorCode::CurveInvalid);
}

}  // namespace
}  // namespace toile
