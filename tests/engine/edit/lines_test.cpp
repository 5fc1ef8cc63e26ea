// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of single lines on a plane, where the answers are known.
#include "toile/edit/lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/curve_checks.h"
#include "support/edit_support.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/edit/draw.h"
#include "toile/edit/measure.h"
#include "toile/edit/shape.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using test::curveOf;
using test::near;
using test::pathOf;
using test::placeOf;

class OnASheet : public testing::Test {
 protected:
  void draw(const std::string& id, const std::vector<Vector3d>& places, bool straight = true) {
    std::vector<SurfacePoint> points;
    for (const Vector3d& place : places) points.push_back(near(document, place));
    const auto drawn = straight ? drawShortest(document, points, {id, "", CurveKind::Seam})
                                : drawThrough(document, points, false, {id, "", CurveKind::Seam});
    ASSERT_TRUE(drawn) << drawn.error();
    document = drawn->document;
  }
  [[nodiscard]] Vector3d at(const Document& of, const std::string& id, double fraction) const {
    return position(*of.model->mesh, pointAtFraction(*of.model->mesh, pathOf(of, id), fraction));
  }

  Document document = test::documentOn(makeReferenceModel("sheet", test::irregularGrid(20, 20)));
};

TEST_F(OnASheet, ReversingTurnsTheLineAndItsSides) {
  draw("line", {{20, 30, 0}, {80, 110, 0}, {180, 100, 0}}, false);
  Design design = *document.design;
  design.curves[0].left.allowance = Length::mm(7);
  document.design = std::make_shared<const Design>(design);
  const auto turned = reverseCurve(document, "line");
  ASSERT_TRUE(turned) << turned.error();
  for (const double f : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_LT((at(*turned, "line", f) - at(document, "line", 1 - f)).norm(), 1e-9) << f;
  }
  EXPECT_EQ(curveOf(*turned, "line").right.allowance, Length::mm(7));
  const auto back = reverseCurve(*turned, "line");
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(pathOf(*back, "line").points, pathOf(document, "line").points);
}

TEST_F(OnASheet, KindsChange) {
  draw("line", {{20, 30, 0}, {80, 110, 0}});
  const auto dart = setCurveKind(document, "line", CurveKind::Dart);
  ASSERT_TRUE(dart) << dart.error();
  EXPECT_EQ(curveOf(*dart, "line").kind, CurveKind::Dart);
  EXPECT_EQ(pathOf(*dart, "line").points, pathOf(document, "line").points);
  EXPECT_FALSE(setCurveKind(document, "other", CurveKind::Dart));
}

TEST_F(OnASheet, ControlsComeAndGo) {
  draw("line", {{20, 100, 0}, {60, 100, 0}, {100, 100, 0}, {140, 100, 0}, {180, 100, 0}}, false);
  const auto handles = [](const Document& of) { return handlesOf(of, "line")->size(); };
  ASSERT_EQ(handles(document), 5U);
  const auto more = insertControl(document, "line", 0.4);
  ASSERT_TRUE(more) << more.error();
  EXPECT_EQ(handles(*more), 6U);
  EXPECT_NEAR(curveLength(*more, "line")->mm(), curveLength(document, "line")->mm(), 1e-9);
  // Pulled aside and taken out again: the line is straight as its neighbours say.
  const auto list = handlesOf(*more, "line");
  std::size_t pulled = 0;
  while (std::abs((*list)[pulled].at - 0.4) > 1e-6) ++pulled;
  const auto bent = moveHandle(*more, "line", {}, pulled, near(document, {84, 112, 0}));
  ASSERT_TRUE(bent) << bent.error();
  EXPECT_GT(curveLength(*bent, "line")->mm(), curveLength(document, "line")->mm() + 1);
  const auto foot = nearestOnPath(*document.model->mesh, pathOf(*bent, "line"), {84, 112, 0});
  const double where = foot.arc / curveLength(*bent, "line")->mm();
  const auto fewer = removeControl(*bent, "line", where, Length::mm(1));
  ASSERT_TRUE(fewer) << fewer.error();
  EXPECT_EQ(handles(*fewer), 5U);
  EXPECT_LT(curveLength(*fewer, "line")->mm(), curveLength(*bent, "line")->mm());
  EXPECT_FALSE(removeControl(*fewer, "line", where, Length::mm(1))) << "there is none";
  EXPECT_FALSE(insertControl(document, "line", 1.5));
}

TEST_F(OnASheet, SplittingAtCrossings) {
  draw("line", {{20, 100, 0}, {180, 100, 0}});
  draw("a", {{60, 40, 0}, {60, 160, 0}});
  draw("b", {{140, 40, 0}, {140, 160, 0}});
  const std::vector<std::string> others{"a", "b"};
  const auto parts = splitAtCrossings(document, "line", others);
  ASSERT_TRUE(parts) << parts.error();
  ASSERT_EQ(parts->curves.size(), 3U);
  double all = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = curveLength(parts->document, parts->curves[i])->mm();
    EXPECT_NEAR(part, i == 1 ? 80 : 40, 1e-6);
    all += part;
  }
  EXPECT_NEAR(all, 160, 1e-6);
  const ModelPoint end = curveOf(parts->document, parts->curves[0]).dataPoints.back();
  EXPECT_EQ(end, curveOf(parts->document, parts->curves[1]).dataPoints.front());
  draw("far", {{10, 10, 0}, {30, 10, 0}});
  const std::vector<std::string> far{"far"};
  EXPECT_EQ(splitAtCrossings(document, "line", far).error().code, ErrorCode::CurveInvalid);
}

TEST_F(OnASheet, ClosingBridgesTheGapSmoothly) {
  draw("arc", {{60, 60, 0}, {140, 60, 0}, {140, 140, 0}, {60, 140, 0}}, false);
  const double open = curveLength(document, "arc")->mm();
  const auto closed = closeCurve(document, "arc");
  ASSERT_TRUE(closed) << closed.error();
  EXPECT_TRUE(curveOf(*closed, "arc").closed);
  EXPECT_GT(curveLength(*closed, "arc")->mm(), open + 80);
  GeodesicLinker linker(document.model->mesh);
  test::expectSound(*closed, linker, "closed");
  EXPECT_FALSE(closeCurve(*closed, "arc")) << "it is";
  // The bridge swings out as the arc does: no corner at the old ends.
  const auto samples = curvatureOf(*closed, "arc", 60);
  ASSERT_TRUE(samples) << samples.error();
  for (const CurvatureSample& sample : *samples) EXPECT_LT(std::abs(sample.curvature), 0.08);
}

TEST_F(OnASheet, RemovingLeavesTheOthers) {
  draw("line", {{20, 100, 0}, {180, 100, 0}});
  draw("a", {{60, 40, 0}, {60, 160, 0}});
  const auto left = removeCurve(document, "line");
  ASSERT_TRUE(left) << left.error();
  ASSERT_EQ(left->design->curves.size(), 1U);
  EXPECT_EQ(left->design->curves[0].id, "a");
  EXPECT_EQ(removeCurve(document, "lin").error().code, ErrorCode::NameNotFound);
}

}  // namespace
}  // namespace toile
