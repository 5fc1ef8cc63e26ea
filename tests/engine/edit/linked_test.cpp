// SPDX-License-Identifier: GPL-3.0-or-later
// What hangs together: live mirror images, lines that end on others, crossings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/curve_checks.h"
#include "support/edit_support.h"
#include "support/result_printing.h"
#include "toile/curve/geodesic.h"
#include "toile/edit/draw.h"
#include "toile/edit/fair.h"
#include "toile/edit/lines.h"
#include "toile/edit/measure.h"
#include "toile/edit/shape.h"
#include "toile/edit/symmetry.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using test::curveOf;
using test::near;
using test::pathOf;
using test::placeOf;

/// A yoke seam over the middle of the torso's front, made symmetric: "yoke" and its live image.
Document withYoke() {
  const Document document = test::documentOn("builtin:torso@1");
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 5; ++i) {
    points.push_back(near(document, {-80.0 + 40 * i, -500, 1000.0 + 15 * i}));
  }
  const auto drawn = drawThrough(document, points, false, {"yoke", "", CurveKind::Seam});
  EXPECT_TRUE(drawn) << drawn.error();
  const auto made = makeSymmetric(drawn->document, "yoke", Side::Left);
  EXPECT_TRUE(made) << made.error();
  return made->document;
}

/// Both halves begin at one point of the middle, and the first link of one goes straight on in that
/// of the other: they are a shortest way there. The next corners are those of any smooth line.
void expectSmoothOnTheMiddle(const Document& document) {
  const Mesh& mesh = *document.model->mesh;
  const SurfacePath half = pathOf(document, "yoke"), image = pathOf(document, "yoke-mirror");
  ASSERT_EQ(half.points.front(), image.points.front());
  EXPECT_NEAR(placeOf(document, half.points.front()).x(), 0, 1e-6);
  const SurfacePath through{{image.points[1], half.points[0], half.points[1]},
                            {image.faceOfSegment[0], half.faceOfSegment[0]},
                            false};
  EXPECT_LT(geodesicDefect(mesh, through), 1e-6);
  // The turn of every corner near the middle.
  double arc = 0;
  for (std::size_t i = 1; i + 1 < half.points.size() && arc < 20; ++i) {
    arc += (placeOf(document, half.points[i]) - placeOf(document, half.points[i - 1])).norm();
    const SurfacePath corner{{half.points[i - 1], half.points[i], half.points[i + 1]},
                             {half.faceOfSegment[i - 1], half.faceOfSegment[i]},
                             false};
    EXPECT_LT(geodesicDefect(mesh, corner), 15 * EIGEN_PI / 180) << arc << " mm from the middle";
  }
}

TEST(LinkedSymmetry, HalvesStaySmoothlyJoined) {
  const Document yoke = withYoke();
  expectSmoothOnTheMiddle(yoke);
  const auto handles = handlesOf(yoke, "yoke");
  ASSERT_TRUE(handles) << handles.error();
  ASSERT_GE(handles->size(), 3U);
  // The end on the middle, pulled up and to the side: it slides along the middle.
  for (const std::string& id : {std::string("yoke"), std::string("yoke-mirror")}) {
    const auto own = handlesOf(yoke, id);
    ASSERT_TRUE(own) << own.error();
    const Vector3d start = placeOf(yoke, own->front().point);
    const auto moved = moveHandle(yoke, id, {}, 0, near(yoke, start + Vector3d(12, -5, 12)));
    ASSERT_TRUE(moved) << moved.error();
    EXPECT_GT(placeOf(yoke, pathOf(*moved, "yoke").points.front()).z(), start.z() + 6);
    SCOPED_TRACE("pulled " + id);
    expectSmoothOnTheMiddle(*moved);
  }
  // The next handle.
  const SurfacePoint to = near(yoke, placeOf(yoke, (*handles)[1].point) + Vector3d(0, 0, 6));
  const auto pulled = moveHandle(yoke, "yoke", {}, 1, to);
  ASSERT_TRUE(pulled) << pulled.error();
  {
    SCOPED_TRACE("the next handle pulled");
    expectSmoothOnTheMiddle(*pulled);
  }
  // The whole line; fairing.
  const SurfacePoint from = (*handles)[1].point;
  const auto shifted =
      moveCurve(yoke, "yoke", from, near(yoke, placeOf(yoke, from) + Vector3d(5, 0, 20)));
  ASSERT_TRUE(shifted) << shifted.error();
  {
    SCOPED_TRACE("moved");
    expectSmoothOnTheMiddle(*shifted);
  }
  const auto faired = fairCurves(yoke, std::vector<std::string>{"yoke"});
  ASSERT_TRUE(faired) << faired.error();
  SCOPED_TRACE("faired");
  expectSmoothOnTheMiddle(faired->document);
}

TEST(LinkedSymmetry, AHalfAndItsImageJoinToOneLine) {
  const Document yoke = withYoke();
  const double half = curveLength(yoke, "yoke")->mm();
  const auto joined = joinCurves(yoke, "yoke", "yoke-mirror");
  ASSERT_TRUE(joined) << joined.error();
  EXPECT_EQ(joined->design->curves.size(), 1U);
  EXPECT_FALSE(curveOf(*joined, "yoke").mirrorOf);
  EXPECT_NEAR(curveLength(*joined, "yoke")->mm(), 2 * half, 1e-6 * half);
  // Made symmetric again: the same halves but for the middle, which is drawn anew.
  const auto again = makeSymmetric(*joined, "yoke", Side::Left);
  ASSERT_TRUE(again) << again.error();
  EXPECT_NEAR(curveLength(again->document, "yoke")->mm(), half, 0.06 * half);
  // Of what is symmetric already there is no second image.
  const auto twice = makeSymmetric(yoke, "yoke-mirror", Side::Right);
  ASSERT_TRUE(twice) << twice.error();
  EXPECT_EQ(twice->document.design->curves.size(), 2U);
  expectSmoothOnTheMiddle(twice->document);
}

TEST(LinkedSymmetry, ImagesAreJoinedByTheirOriginals) {
  const Document yoke = withYoke();
  const auto parts = splitCurve(yoke, "yoke", std::vector<double>{0.5});
  ASSERT_TRUE(parts) << parts.error();
  ASSERT_EQ(parts->document.design->curves.size(), 4U);
  const std::string second = parts->curves[1];
  std::string image;
  for (const StylingCurve& curve : parts->document.design->curves) {
    if (curve.mirrorOf == second) image = curve.id;
  }
  const auto joined = joinCurves(parts->document, "yoke-mirror", image);
  ASSERT_TRUE(joined) << joined.error();
  EXPECT_EQ(joined->design->curves.size(), 2U);
  EXPECT_EQ(curveOf(*joined, "yoke-mirror").mirrorOf, "yoke");
  EXPECT_NEAR(curveLength(*joined, "yoke-mirror")->mm(), curveLength(yoke, "yoke")->mm(), 1e-6);
}

TEST(Lines, MovingCarriesWhatEndsOnThem) {
  const Document document = test::documentOn("builtin:torso@1");
  const auto line = drawThrough(
      document,
      std::vector<SurfacePoint>{near(document, {60, -500, 920}), near(document, {60, -500, 1000}),
                                near(document, {60, -500, 1080})},
      false, {"line", "", CurveKind::Seam});
  ASSERT_TRUE(line) << line.error();
  const SurfacePoint foot =
      pointAtFraction(*document.model->mesh, pathOf(line->document, "line"), 0.5);
  const auto branch = drawThrough(
      line->document, std::vector<SurfacePoint>{foot, near(document, {120, -500, 1010})}, false,
      {"branch", "", CurveKind::Seam});
  ASSERT_TRUE(branch) << branch.error();
  const auto shared = shareCrossings(branch->document);
  ASSERT_TRUE(shared) << shared.error();
  const auto moved = moveCurve(shared->document, "line", foot,
                               near(document, placeOf(document, foot) + Vector3d(-15, 0, 0)));
  ASSERT_TRUE(moved) << moved.error();
  const auto& data = curveOf(*moved, "line").dataPoints;
  const ModelPoint end = curveOf(*moved, "branch").dataPoints.front();
  EXPECT_NE(std::find(data.begin(), data.end(), end), data.end());
  EXPECT_LT(placeOf(document, *toSurfacePoint(*document.model->mesh, end)).x(),
            placeOf(document, foot).x() - 8);
  EXPECT_EQ(curveOf(*moved, "branch").dataPoints.back(),
            curveOf(shared->document, "branch").dataPoints.back());
}

// Lines along each other meet wherever rounding lets them; what is stored must be read as it was
// shared. One line takes its way at once, the others in steps, aside by ever smaller parts of a mm.
TEST(Network, SharesAllMeetingsOfLinesThatRunAlongEachOther) {
  for (const double aside : {0.0, 1e-9, 1e-6, 1e-5, 1e-3}) {
    Document document = test::documentOn("builtin:torso@1");
    const Mesh& mesh = *document.model->mesh;
    const SurfacePoint from = near(document, {-110, -500, 930}),
                       to = near(document, {110, -500, 1060});
    const auto whole =
        drawShortest(document, std::vector<SurfacePoint>{from, to}, {"whole", "", CurveKind::Seam});
    ASSERT_TRUE(whole) << whole.error();
    document = whole->document;
    const SurfacePath path = pathOf(document, "whole");
    for (const int steps : {3, 7}) {
      std::vector<SurfacePoint> points;
      for (int i = 0; i <= steps; ++i) {
        const double part = (i + 0.3) / (steps + 0.6);
        const Vector3d on = position(mesh, pointAtFraction(mesh, path, part));
        points.push_back(near(document, on + Vector3d(0, 0, i % 2 == 0 ? aside : -aside)));
      }
      const auto drawn = drawShortest(document, points);
      ASSERT_TRUE(drawn) << drawn.error();
      document = drawn->document;
    }
    const auto shared = shareCrossings(document);
    ASSERT_TRUE(shared) << shared.error();
    GeodesicLinker linker(document.model->mesh);
    const std::string context = "aside " + std::to_string(1e6 * aside) + " nm";
    test::expectAllShared(shared->document, linker, context);
    for (const StylingCurve& curve : shared->document.design->curves) {
      const auto& data = curve.dataPoints;
      EXPECT_EQ(std::adjacent_find(data.begin(), data.end()), data.end()) << context;
    }
    // What is shared stays as it is.
    const auto again = shareCrossings(shared->document);
    ASSERT_TRUE(again) << again.error();
    EXPECT_EQ(*again->document.design, *shared->document.design) << context;
  }
}

TEST(Network, SaysWhichCrossingsItCannotShare) {
  const Document yoke = withYoke();
  Design design = *yoke.design;
  StylingCurve broken;
  broken.id = "broken";
  broken.way = SmoothWay{{ModelPoint{VertexId(99999999)}, ModelPoint{VertexId(1)}}};
  design.curves.push_back(broken);
  const Document document{std::make_shared<const Design>(design), yoke.model};
  const auto shared = shareCrossings(document);
  ASSERT_TRUE(shared) << shared.error();
  ASSERT_EQ(shared->findings.size(), 1U);
  EXPECT_EQ(shared->findings[0].code, "crossings-not-shared");
  EXPECT_EQ(shared->findings[0].where, std::vector<Element>{Element::curve("broken")});
  const std::vector<std::string> named{"broken"};
  EXPECT_FALSE(shareCrossings(document, named));
}

}  // namespace
}  // namespace toile
