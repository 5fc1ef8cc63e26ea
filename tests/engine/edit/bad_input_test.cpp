// SPDX-License-Identifier: GPL-3.0-or-later
// What a hand does by mistake: a clear refusal or a sensible result, never a damaged document.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/curve_checks.h"
#include "support/edit_support.h"
#include "support/result_printing.h"
#include "toile/edit/draw.h"
#include "toile/edit/fair.h"
#include "toile/edit/lines.h"
#include "toile/edit/shape.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using test::near;
using test::placeOf;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class BadInput : public testing::Test {
 protected:
  template <class Value>
  static void expectRefused(const Result<Value>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code) << result.error();
    EXPECT_FALSE(result.error().message.empty());
  }
  void expectFine(const Document& document) {
    GeodesicLinker linker(document.model->mesh);
    test::expectSound(document, linker, "after the edit");
  }
  SurfacePoint at(double x, double z) { return near(body, {x, -500, z}); }

  Document body = test::documentOn("builtin:torso@1");
};

TEST_F(BadInput, PointsOffTheBody) {
  const SurfacePoint off{VertexId(99999999)};
  const SurfacePoint odd{SurfacePoint::InFace{FaceId(3), Vector3d(0.5, 0.7, -0.2)}};
  const SurfacePoint nan{SurfacePoint::OnEdge{EdgeId(3), kNan}};
  for (const SurfacePoint& bad : {off, odd, nan}) {
    const std::vector<SurfacePoint> points{at(0, 1000), bad, at(60, 1000)};
    expectRefused(drawThrough(body, points, false), ErrorCode::CurveInvalid);
    expectRefused(drawShortest(body, points), ErrorCode::CurveInvalid);
    expectRefused(drawGirth(body, bad, {0, 0, 1}), ErrorCode::CurveInvalid);
    const auto line =
        drawThrough(body, std::vector<SurfacePoint>{at(0, 950), at(20, 1000), at(0, 1050)}, false);
    ASSERT_TRUE(line) << line.error();
    const std::string id = line->curves[0];
    expectRefused(moveHandle(line->document, id, {}, 1, bad), ErrorCode::CurveInvalid);
    expectRefused(moveCurve(line->document, id, at(0, 950), bad), ErrorCode::CurveInvalid);
    expectRefused(drawDart(line->document, id, bad), ErrorCode::CurveInvalid);
  }
}

TEST_F(BadInput, EqualPoints) {
  const SurfacePoint p = at(0, 1000), q = at(50, 1000);
  expectRefused(drawThrough(body, std::vector<SurfacePoint>{p, p}, false), ErrorCode::CurveInvalid);
  expectRefused(drawShortest(body, std::vector<SurfacePoint>{p, p}), ErrorCode::CurveInvalid);
  const auto twice = drawThrough(body, std::vector<SurfacePoint>{p, p, q, q}, false);
  if (twice) expectFine(twice->document);
}

TEST_F(BadInput, StrokesThatAreNone) {
  const View view;
  expectRefused(drawStroke(body, view, {}), ErrorCode::CurveInvalid);
  expectRefused(drawStroke(body, view, std::vector<StrokeSample>{{{0, 0}, 0, 1}}),
                ErrorCode::CurveInvalid);
  expectRefused(drawStroke(body, view, std::vector<StrokeSample>(50, {{3, 4}, 0, 1})),
                ErrorCode::CurveInvalid);
  expectRefused(
      drawStroke(body, view, std::vector<StrokeSample>{{{0, 0}, 0, 1}, {{kNan, 0}, 0, 1}}),
      ErrorCode::InvalidArgument);
  expectRefused(
      drawStroke(body, view, std::vector<StrokeSample>{{{5000, 0}, 0, 1}, {{5100, 0}, 0, 1}}),
      ErrorCode::LeavesSilhouette);
}

TEST_F(BadInput, AThousandPoints) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 1000; ++i) {
    const double turn = 0.13 * i;
    points.push_back(near(body, {200 * std::cos(turn), 200 * std::sin(turn), 950 + 0.1 * i}));
  }
  const auto drawn = drawThrough(body, points, false);
  ASSERT_TRUE(drawn) << drawn.error();
  expectFine(drawn->document);
  const auto handles = handlesOf(drawn->document, drawn->curves[0]);
  ASSERT_TRUE(handles) << handles.error();
  const auto moved =
      moveHandle(drawn->document, drawn->curves[0], {}, 500,
                 near(body, placeOf(body, (*handles)[500].point) + Vector3d(3, 0, 3)));
  ASSERT_TRUE(moved) << moved.error();
  expectFine(*moved);
}

TEST_F(BadInput, TwentyTimesThroughOneFace) {
  const Mesh& mesh = *body.model->mesh;
  std::vector<SurfacePoint> zigzag;
  for (int i = 0; i < 20; ++i) {
    zigzag.push_back(
        makeSurfacePoint(mesh, FaceId(500), {1.0 + i, i % 2 == 0 ? 4.0 : 12.0, 20.0 - i}));
  }
  const auto tangled = drawShortest(body, zigzag);
  ASSERT_TRUE(tangled) << tangled.error();
  expectFine(tangled->document);
  const auto crossed =
      drawShortest(tangled->document,
                   std::vector<SurfacePoint>{makeSurfacePoint(mesh, FaceId(500), {1, 8, 18}),
                                             makeSurfacePoint(mesh, FaceId(500), {20, 8, 1})});
  ASSERT_TRUE(crossed) << crossed.error();
  const auto shared = shareCrossings(crossed->document);
  ASSERT_TRUE(shared) << shared.error();
  expectFine(shared->document);
  GeodesicLinker linker(body.model->mesh);
  test::expectAllShared(shared->document, linker, "zigzag");
}

TEST_F(BadInput, ClosedCurvesOfTwoPoints) {
  const std::vector<SurfacePoint> two{at(0, 1000), at(50, 1000)};
  expectRefused(drawThrough(body, two, true), ErrorCode::CurveInvalid);
  const auto shortest = drawShortest(body, std::vector<SurfacePoint>{at(0, 1000), at(50, 1000)});
  ASSERT_TRUE(shortest) << shortest.error();
  const auto closed = closeCurve(shortest->document, shortest->curves[0]);
  if (closed) {
    expectFine(*closed);
  } else {
    EXPECT_EQ(closed.error().code, ErrorCode::CurveInvalid);
  }
}

TEST_F(BadInput, FairingOfWhatIsFixedEverywhere) {
  const auto line = drawShortest(body, std::vector<SurfacePoint>{at(0, 1000), at(50, 1000)});
  ASSERT_TRUE(line) << line.error();
  expectRefused(fairCurves(line->document, {}), ErrorCode::CurveInvalid);
  // A line so short that its ends, which keep place and direction, are nearly all of it.
  const auto shortest = drawShortest(body, std::vector<SurfacePoint>{at(30, 1000), at(33, 1002)},
                                     {"short", "", CurveKind::Seam});
  ASSERT_TRUE(shortest) << shortest.error();
  const auto faired = fairCurves(shortest->document, std::vector<std::string>{"short"});
  ASSERT_TRUE(faired) << faired.error();
  expectFine(faired->document);
  EXPECT_LT(faired->curves[0].deviation.mm(), 0.01);
  expectRefused(fairCurves(line->document, std::vector<std::string>{"no such line"}),
                ErrorCode::NameNotFound);
}

}  // namespace
}  // namespace toile
