// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/edit/fair.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/edit_support.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/edit/draw.h"
#include "toile/edit/lines.h"
#include "toile/edit/measure.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// A ball that is longer in every direction than in the next.
Document ball() {
  const Eigen::Matrix3d scale = Vector3d(200, 140, 100).asDiagonal();
  return test::documentOn(makeReferenceModel(
      "ball", test::transformed(test::icosphere(1, 4), scale, Vector3d::Zero())));
}

/// Five rings and five lines from near one pole to near the other; a ripple of some mm, as a
/// transfer leaves it.
Document net(double ripple) {
  Document document = ball();
  for (int i = 0; i < 10; ++i) {
    std::vector<SurfacePoint> points;
    const int count = i < 5 ? 40 : 25;
    for (int k = 0; k < count; ++k) {
      const bool isEnd = i >= 5 && (k == 0 || k + 1 == count);
      const double wave = isEnd ? 0 : ripple / 140 * std::sin(1.9 * k + i);
      const double turn = i < 5 ? 2 * pi * k / count : 2 * pi * (i - 5) / 5 + 0.2;
      const double height = i < 5 ? -0.8 + 0.4 * i : -1.2 + 2.4 * k / (count - 1);
      const double u = turn + (i < 5 ? 0 : wave), v = height + (i < 5 ? wave : 0);
      points.push_back(test::near(document, {200 * std::cos(v) * std::cos(u),
                                             140 * std::cos(v) * std::sin(u), 100 * std::sin(v)}));
    }
    const auto drawn = drawThrough(document, points, i < 5,
                                   {(i < 5 ? "ring" : "line") + std::to_string(i % 5), "", {}});
    EXPECT_TRUE(drawn) << drawn.error();
    document = drawn->document;
  }
  return document;
}

std::vector<std::string> allOf(const Document& document) {
  std::vector<std::string> ids;
  for (const StylingCurve& curve : document.design->curves) ids.push_back(curve.id);
  return ids;
}

std::size_t sharedPoints(const Document& document, const std::string& a, const std::string& b) {
  const auto &first = test::curveOf(document, a).dataPoints,
             &second = test::curveOf(document, b).dataPoints;
  return static_cast<std::size_t>(std::count_if(first.begin(), first.end(), [&](const auto& p) {
    return std::find(second.begin(), second.end(), p) != second.end();
  }));
}

double farthest(const Document& document, const SurfacePath& from, const SurfacePath& to) {
  const Mesh& mesh = *document.model->mesh;
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d p = position(mesh, pointAtFraction(mesh, from, i / 200.0));
    worst = std::max(worst, nearestOnPath(mesh, to, p).distance);
  }
  return worst;
}

// The ripple goes, the lines that were meant come back, and they cross as before.
TEST(FairCurves, ANetworkLosesItsRipples) {
  const Document plain = net(0), rippled = net(4);
  const std::vector<std::string> ids = allOf(rippled);
  FairCurvesOptions options;
  options.ends = FairEnd::Pinned;  // the ripple gave the ends a direction that is not meant
  const auto faired = fairCurves(rippled, ids, options);
  ASSERT_TRUE(faired) << faired.error();
  ASSERT_EQ(faired->curves.size(), 10U);
  double before = 0, after = 0;
  int bendsBefore = 0, bendsAfter = 0;
  for (const FairedCurve& curve : faired->curves) {
    before += curve.variationBefore;
    after += curve.variationAfter;
    bendsBefore += curve.inflectionsBefore;
    bendsAfter += curve.inflectionsAfter;
    const SurfacePath now = test::pathOf(faired->document, curve.id);
    const SurfacePath meant = test::pathOf(plain, curve.id);
    EXPECT_LT(farthest(plain, now, meant), 2.5) << curve.id;
    EXPECT_LT(curve.deviation.mm(), 8) << curve.id;
    EXPECT_NEAR(curve.deviation.mm(),
                std::max(farthest(plain, now, test::pathOf(rippled, curve.id)),
                         farthest(plain, test::pathOf(rippled, curve.id), now)),
                1)  // measured at the samples
        << curve.id;
  }
  EXPECT_LT(after, 0.12 * before);
  EXPECT_LT(bendsAfter, bendsBefore / 4);
  for (int r = 0; r < 5; ++r) {
    for (int l = 0; l < 5; ++l) {
      const std::string ring = "ring" + std::to_string(r), line = "line" + std::to_string(l);
      EXPECT_EQ(meetingsOf(faired->document, ring, line)->size(), 1U) << ring << ' ' << line;
      EXPECT_EQ(sharedPoints(faired->document, ring, line), 1U) << ring << ' ' << line;
    }
  }
}

// The undisturbed lines say how many bends are meant: no faired line has more.
TEST(FairCurves, BendsNoMoreThanItsSource) {
  const Document plain = net(0), rippled = net(4);
  FairCurvesOptions options;
  options.source = &plain;
  options.ends = FairEnd::Pinned;
  const auto faired = fairCurves(rippled, allOf(rippled), options);
  ASSERT_TRUE(faired) << faired.error();
  const auto untouched = fairCurves(plain, allOf(plain), options);
  ASSERT_TRUE(untouched) << untouched.error();
  for (std::size_t i = 0; i < faired->curves.size(); ++i) {
    EXPECT_LE(faired->curves[i].inflectionsAfter, untouched->curves[i].inflectionsBefore)
        << faired->curves[i].id << ' ' << faired->curves[i].wavelength.mm();
    // What is smooth already stays where it is.
    EXPECT_LT(untouched->curves[i].deviation.mm(), 1.5) << untouched->curves[i].id;
  }
}

TEST(FairCurves, KeepsCrossingsWhereTheUserFixesThem) {
  const Document rippled = shareCrossings(net(4))->document;
  FairCurvesOptions options;
  options.keepCrossings = true;
  const auto faired = fairCurves(rippled, allOf(rippled), options);
  ASSERT_TRUE(faired) << faired.error();
  for (int r = 0; r < 5; ++r) {
    for (int l = 0; l < 5; ++l) {
      const std::string ring = "ring" + std::to_string(r), line = "line" + std::to_string(l);
      const auto& was = test::curveOf(rippled, ring).dataPoints;
      const auto& on = test::curveOf(rippled, line).dataPoints;
      const auto& now = test::curveOf(faired->document, ring).dataPoints;
      for (const ModelPoint& point : was) {
        if (std::find(on.begin(), on.end(), point) == on.end()) continue;
        EXPECT_NE(std::find(now.begin(), now.end(), point), now.end()) << ring << ' ' << line;
      }
    }
  }
  // One line alone: what it crosses stays as it is, and so do the crossings.
  const std::vector<std::string> one{"ring2"};
  const auto alone = fairCurves(rippled, one);
  ASSERT_TRUE(alone) << alone.error();
  EXPECT_EQ(test::pathOf(alone->document, "line1").points, test::pathOf(rippled, "line1").points);
  for (int l = 0; l < 5; ++l) {
    EXPECT_EQ(sharedPoints(alone->document, "ring2", "line" + std::to_string(l)), 1U);
  }
}

// A V with a ripple on both legs: the ripple goes, the point of the V stays, as a corner.
TEST(FairCurves, KeepsCorners) {
  Document document = ball();
  StylingCurve v;
  v.id = "v";
  SmoothWay way;
  for (int k = 0; k <= 40; ++k) {
    const double x = -90 + 4.5 * k, y = 1.1 * std::abs(x) + (k == 20 ? 0 : 2 * std::sin(2.1 * k));
    way.controls.emplace_back(
        toModelPoint(*document.model->mesh, test::near(document, {x, y - 60, 100})));
  }
  way.corners = {20};
  v.way = way;
  Design design = *document.design;
  design.curves.push_back(v);
  document.design = std::make_shared<const Design>(design);
  const std::vector<std::string> ids{"v"};
  const auto faired = fairCurves(document, ids);
  ASSERT_TRUE(faired) << faired.error();
  const auto& made = std::get<SmoothWay>(test::curveOf(faired->document, "v").way);
  ASSERT_EQ(made.corners.size(), 1U);
  EXPECT_EQ(made.controls[made.corners[0]], way.controls[20]);
  EXPECT_LT(faired->curves[0].variationAfter, 0.15 * faired->curves[0].variationBefore);
  const Mesh& mesh = *document.model->mesh;
  const SurfacePath path = test::pathOf(faired->document, "v");
  const Vector3d corner =
      test::placeOf(document, *toSurfacePoint(mesh, std::get<ModelPoint>(way.controls[20])));
  const double arc = nearestOnPath(mesh, path, corner).arc, all = length(mesh, path);
  const auto at = [&](double s) { return position(mesh, pointAtFraction(mesh, path, s / all)); };
  const Vector3d in = at(arc) - at(arc - 12), out = at(arc + 12) - at(arc);
  const double turned = std::atan2(in.cross(out).norm(), in.dot(out)) * 180 / pi;
  EXPECT_NEAR(turned, 2 * std::atan(1.1) * 180 / pi, 8);
}

}  // namespace
}  // namespace toile
