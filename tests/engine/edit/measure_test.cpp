// SPDX-License-Identifier: GPL-3.0-or-later
// Known answers on planes, tubes and balls.
#include "toile/edit/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/edit_support.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/edit/draw.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using test::near;

Document sheet() {
  return test::documentOn(makeReferenceModel("sheet", test::irregularGrid(20, 20)));
}

TEST(Measure, LengthsAndStretchesOnAPlane) {
  Document document = sheet();
  const auto drawn = drawShortest(
      document,
      std::vector<SurfacePoint>{near(document, {20, 30, 0}), near(document, {80, 110, 0})},
      {"line", "", CurveKind::Seam});
  ASSERT_TRUE(drawn) << drawn.error();
  EXPECT_NEAR(curveLength(drawn->document, "line")->mm(), 100, 1e-9);
  EXPECT_NEAR(stretchLength(drawn->document, "line", {0.2, 0.7})->mm(), 50, 1e-9);
  EXPECT_EQ(stretchLength(drawn->document, "line", {0.2, 1.7}).error().code,
            ErrorCode::InvalidArgument);
  EXPECT_EQ(curveLength(drawn->document, "lin").error().code, ErrorCode::NameNotFound);
  // Over the start of a closed one.
  const auto ring = drawThrough(
      document,
      std::vector<SurfacePoint>{near(document, {50, 50, 0}), near(document, {150, 50, 0}),
                                near(document, {150, 150, 0}), near(document, {50, 150, 0})},
      true, {"ring", "", CurveKind::Seam});
  ASSERT_TRUE(ring) << ring.error();
  const double all = curveLength(ring->document, "ring")->mm();
  EXPECT_NEAR(stretchLength(ring->document, "ring", {0.9, 0.2})->mm(), 0.3 * all, 1e-9);
}

TEST(Measure, DistancesRunOverTheSurface) {
  const double radius = 60;
  const int segments = 48;
  const ReferenceModel tube = makeReferenceModel("tube", test::cylinder(radius, 200, segments, 20));
  const auto at = [&](int i, double z) {
    const double turn = 2 * pi * i / segments;
    return tube.index->closestPoint({radius * std::cos(turn), radius * std::sin(turn), z}).point;
  };
  // A quarter round and up: straight on the unrolled tube.
  const double quarter = segments / 4 * 2 * radius * std::sin(pi / segments);
  EXPECT_NEAR(surfaceDistance(tube, at(0, 50), at(segments / 4, 130))->mm(),
              std::hypot(quarter, 80), 1e-9);
  EXPECT_EQ(surfaceDistance(tube, at(3, 50), at(3, 50))->mm(), 0);
  EXPECT_EQ(surfaceDistance(tube, {VertexId(99999)}, at(0, 50)).error().code,
            ErrorCode::CurveInvalid);
  EXPECT_NEAR(girthThrough(tube, at(5, 77), Vector3d(0, 0, 1))->mm(),
              2 * segments * radius * std::sin(pi / segments), 1e-9);
  EXPECT_FALSE(girthThrough(tube, {VertexId(99999)}, Vector3d(0, 0, 1)));
}

TEST(Measure, AnglesBetweenCurves) {
  Document document = sheet();
  const auto line = [&](const char* id, Vector3d a, Vector3d b) {
    const auto drawn =
        drawShortest(document, std::vector<SurfacePoint>{near(document, a), near(document, b)},
                     {id, "", CurveKind::Seam});
    ASSERT_TRUE(drawn) << drawn.error();
    document = drawn->document;
  };
  line("base", {20, 100, 0}, {180, 100, 0});
  line("steep", {60, 40, 0}, {120, 160, 0});
  line("back", {120, 160, 0}, {60, 40, 0});
  const auto meetings = meetingsOf(document, "base", "steep");
  ASSERT_TRUE(meetings) << meetings.error();
  ASSERT_EQ(meetings->size(), 1U);
  EXPECT_NEAR(meetings->front().atFirst, (90.0 - 20) / 160, 1e-9);
  EXPECT_NEAR(meetings->front().atSecond, 0.5, 1e-9);
  const double angle = std::atan2(120, 60) * 180 / pi;
  EXPECT_NEAR(meetings->front().angle.degrees(), angle, 1e-6);
  EXPECT_NEAR(meetingsOf(document, "base", "back")->front().angle.degrees(), 180 - angle, 1e-6);
}

// A circle on a plane bends by 1/radius everywhere, to its left; a girth of a ball in its middle
// does not bend on the surface at all.
TEST(Measure, CurvatureOfALine) {
  Document document = test::documentOn(makeReferenceModel("sheet", test::grid(20, 20)));
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 24; ++i) {
    const double turn = 2 * pi * i / 24;
    points.push_back(near(document, {100 + 60 * std::cos(turn), 100 + 60 * std::sin(turn), 0}));
  }
  const auto circle = drawThrough(document, points, true, {"circle", "", CurveKind::Seam});
  ASSERT_TRUE(circle) << circle.error();
  const auto samples = curvatureOf(circle->document, "circle", 36);
  ASSERT_TRUE(samples) << samples.error();
  ASSERT_EQ(samples->size(), 36U);
  for (const CurvatureSample& sample : *samples) {
    EXPECT_NEAR(sample.curvature, 1.0 / 60, 0.05 / 60) << sample.arc;
  }
  EXPECT_FALSE(curvatureOf(circle->document, "circle", 2));

  const Document ball = test::documentOn(makeReferenceModel("ball", test::icosphere(100, 5)));
  const auto girth = drawGirth(ball, near(ball, {100, 0, 0}), {0, 0, 1}, {"girth", "", {}});
  ASSERT_TRUE(girth) << girth.error();
  const auto straight = curvatureOf(girth->document, "girth", 60);
  ASSERT_TRUE(straight) << straight.error();
  for (const CurvatureSample& sample : *straight) EXPECT_NEAR(sample.curvature, 0, 2e-4);
}

}  // namespace
}  // namespace toile
