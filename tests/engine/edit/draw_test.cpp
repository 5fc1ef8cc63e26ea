// SPDX-License-Identifier: GPL-3.0-or-later
// Ways to draw a line that are not by hand.
#include "toile/edit/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/curve_checks.h"
#include "support/edit_support.h"
#include "support/result_printing.h"
#include "toile/edit/measure.h"
#include "toile/edit/shape.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::curveOf;
using test::near;
using test::pathOf;
using test::placeOf;

class OnTheTorso : public testing::Test {
 protected:
  void expectFine(const Document& document) {
    GeodesicLinker linker(document.model->mesh);
    test::expectSound(document, linker, "after drawing");
  }
  Document body = test::documentOn("builtin:torso@1");
};

// The controls appear where they were set on the view plane, and the line between them too.
TEST_F(OnTheTorso, InTheViewItIsSeenWhereItWasDrawn) {
  ViewWay way;
  way.view.perspective = false;
  way.controls = {{-80, -40}, {-20, 10}, {40, 0}, {90, 60}};
  const auto drawn = drawInView(body, way, false, {"line", "", CurveKind::Seam});
  ASSERT_TRUE(drawn) << drawn.error();
  ASSERT_EQ(drawn->curves.size(), 1U);
  EXPECT_TRUE(drawn->findings.empty());
  expectFine(drawn->document);
  const SurfacePath path = pathOf(drawn->document, "line");
  const auto seen = [&](const SurfacePoint& point) {
    const Vector3d p = placeOf(body, point);
    return Vector2d(p.x(), p.z() - way.view.target.z());
  };
  EXPECT_LT((seen(path.points.front()) - way.controls.front()).norm(), 1e-6);
  EXPECT_LT((seen(path.points.back()) - way.controls.back()).norm(), 1e-6);
  for (const SurfacePoint& point : path.points)
    EXPECT_LT(placeOf(body, point).y(), 0) << "in front";

  // Past the outline: what is on the model is kept, and it is said where it was cut.
  way.controls = {{-40, 0}, {40, 20}, {2500, 40}};
  const auto cut = drawInView(body, way, false);
  ASSERT_TRUE(cut) << cut.error();
  ASSERT_FALSE(cut->findings.empty());
  EXPECT_EQ(cut->findings[0].code, "cut-at-silhouette");
  way.controls = {{2400, 0}, {2500, 40}};
  EXPECT_EQ(drawInView(body, way, false).error().code, ErrorCode::LeavesSilhouette);
}

TEST_F(OnTheTorso, AlongACurveOfTheModel) {
  const auto& [name, whole] = *body.model->curves.begin();
  const double all = length(*body.model->mesh, whole);
  const auto drawn = drawAlongModelCurve(body, name, {0.1, 0.4}, {"line", "", CurveKind::Feature});
  ASSERT_TRUE(drawn) << drawn.error();
  expectFine(drawn->document);
  EXPECT_NEAR(curveLength(drawn->document, "line")->mm(), 0.3 * all, 1e-6 * all);
  for (const double f : {0.0, 0.3, 0.8, 1.0}) {
    const SurfacePoint point =
        pointAtFraction(*body.model->mesh, pathOf(drawn->document, "line"), f);
    EXPECT_LT(nearestOnPath(*body.model->mesh, whole, placeOf(body, point)).distance, 1e-6);
  }
  EXPECT_EQ(drawAlongModelCurve(body, "no such curve", {0, 1}).error().code,
            ErrorCode::NameNotFound);
}

TEST_F(OnTheTorso, AlongMeshEdges) {
  const Mesh& mesh = *body.model->mesh;
  const auto vertexNear = [&](const Vector3d& place) {
    return mesh.vertices(facesOf(mesh, near(body, place)).front())[0];
  };
  const std::vector<VertexId> vertices{vertexNear({-60, -500, 950}), vertexNear({0, -500, 1000}),
                                       vertexNear({60, -500, 960})};
  const auto drawn = drawAlongEdges(body, vertices, {"line", "", CurveKind::Seam});
  ASSERT_TRUE(drawn) << drawn.error();
  expectFine(drawn->document);
  const SurfacePath path = pathOf(drawn->document, "line");
  std::vector<VertexId> passed;
  for (const SurfacePoint& point : path.points) {
    const auto* vertex = std::get_if<VertexId>(&point.at);
    ASSERT_NE(vertex, nullptr);
    if (!passed.empty()) {
      EXPECT_TRUE(mesh.findEdge(passed.back(), *vertex).isValid());
    }
    passed.push_back(*vertex);
  }
  for (const VertexId vertex : vertices) {
    EXPECT_NE(std::find(passed.begin(), passed.end(), vertex), passed.end());
  }
  EXPECT_FALSE(drawAlongEdges(body, std::vector<VertexId>{VertexId(99999999), vertices[0]}));
}

// A handle under the cursor goes to where the cursor points.
TEST_F(OnTheTorso, AHandleFollowsTheRayOfTheCursor) {
  const auto drawn = drawThrough(
      body,
      std::vector<SurfacePoint>{near(body, {-60, -500, 950}), near(body, {0, -500, 1000}),
                                near(body, {60, -500, 960})},
      false, {"line", "", CurveKind::Seam});
  ASSERT_TRUE(drawn) << drawn.error();
  auto drag = CurveDrag::begin(drawn->document, "line", {}, 1);
  ASSERT_TRUE(drag) << drag.error();
  const View view;
  for (const Vector2d& cursor : {Vector2d(5, 4), Vector2d(12, 10), Vector2d(18, 16)}) {
    const Ray ray = rayThrough(view, cursor);
    const Result<void> moved = drag->moveUnder(ray);
    ASSERT_TRUE(moved) << moved.error();
    const auto hit = body.model->index->firstVisibleHit(ray.origin, ray.direction);
    ASSERT_TRUE(hit);
    EXPECT_LT((placeOf(body, drag->handle()) - hit->position).norm(), 0.5);
  }
  const auto document = drag->document();
  ASSERT_TRUE(document) << document.error();
  expectFine(*document);
}

}  // namespace
}  // namespace toile
