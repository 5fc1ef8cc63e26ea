// SPDX-License-Identifier: GPL-3.0-or-later
// Cursor paths as a hand took them, in places where limbs are near each other. The curve stays on
// its limb: its links stay short, and the handle goes no farther than the cursor leads it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "support/curve_checks.h"
#include "support/edit_support.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/edit/draw.h"
#include "toile/edit/shape.h"
#include "toile/model/reference_model.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using test::near;
using test::placeOf;

struct Recorded {
  const char* name;
  /// Points that the line is drawn through, mm.
  std::vector<Vector3d> line;
  std::size_t handle;  ///< index of the control point that is taken
  /// Of the cursor, mm, in space: a hand does not stay on the surface.
  std::vector<Vector3d> way;
  double leastTravel;  ///< mm that the handle must go
  /// Where no point of the curve may come.
  bool (*isOff)(const Vector3d& place);
};

/// On female_average, whose left arm hangs from (173, -16, 1360) over the elbow (325, -30, 1130) to
/// the wrist (433, -160, 1020), and whose thighs meet below the crotch (0, -64, 774).
const std::vector<Recorded>& recordedDrags() {
  static const std::vector<Recorded> drags{
      {"behind the arm, towards the back",
       {{270, -60, 1230}, {300, 60, 1215}, {330, 20, 1150}},
       1,
       {{290, 62, 1205}, {270, 70, 1195}, {240, 75, 1190}, {225, 75, 1188}, {210, 72, 1186}},
       15,
       [](const Vector3d& p) { return p.x() < 190; }},
      {"between the thighs",
       {{60, -140, 690}, {10, -60, 680}, {60, 60, 670}},
       1,
       {{6, -58, 682}, {-4, -55, 685}, {-20, -52, 690}, {-45, -50, 692}, {-70, -50, 690}},
       0,
       [](const Vector3d& p) { return p.x() < -1; }},
      {"over the shoulder",
       {{110, -150, 1290}, {115, -60, 1400}, {110, 80, 1290}},
       1,
       {{118, -45, 1405}, {122, -20, 1410}, {125, 10, 1405}, {125, 40, 1390}, {122, 65, 1360}},
       40,
       [](const Vector3d& p) { return p.z() > 1405; }},
      {"through the armpit",
       {{150, -40, 1150}, {160, -44, 1215}, {215, -44, 1230}},
       1,
       {{162, -44, 1228}, {165, -44, 1240}, {172, -44, 1250}, {180, -44, 1248}, {192, -44, 1240}},
       15,
       [](const Vector3d& p) { return p.z() > 1330; }},
  };
  return drags;
}

TEST(RecordedDrags, StayOnTheirLimb) {
  TOILE_TEST_DATA_OR_SKIP(file, "bodies/female_average.ply");
  const Result<ReferenceModel> model = readModel(file, FileUnit::Millimetre);
  ASSERT_TRUE(model) << model.error();
  const Document body = test::documentOn(*model);
  const Mesh& mesh = *body.model->mesh;
  GeodesicLinker linker(body.model->mesh);
  for (const Recorded& recorded : recordedDrags()) {
    std::vector<SurfacePoint> points;
    for (const Vector3d& place : recorded.line) points.push_back(near(body, place));
    const auto drawn = drawThrough(body, points, false, {"line", "", CurveKind::Seam});
    ASSERT_TRUE(drawn) << recorded.name << drawn.error();
    auto drag = CurveDrag::begin(drawn->document, "line", {}, recorded.handle);
    ASSERT_TRUE(drag) << recorded.name << drag.error();
    const Vector3d start = placeOf(body, drag->handle());
    Vector3d cursor = start, handle = start;
    double farthest = 0;
    for (const Vector3d& place : recorded.way) {
      const Result<void> moved = drag->moveTo(place);
      ASSERT_TRUE(moved) << recorded.name << moved.error();
      const Vector3d now = placeOf(body, drag->handle());
      EXPECT_LT((now - handle).norm(), 2 * (place - cursor).norm() + 2 * mesh.meanEdgeLength())
          << recorded.name;
      handle = now;
      cursor = place;
      farthest = std::max(farthest, (now - start).norm());
      for (const SurfacePoint& point : drag->path().points) {
        const Vector3d p = placeOf(body, point);
        ASSERT_FALSE(recorded.isOff(p)) << recorded.name << ": " << p.transpose();
      }
    }
    EXPECT_GE(farthest, recorded.leastTravel) << recorded.name;
    const auto done = drag->document();
    ASSERT_TRUE(done) << recorded.name << done.error();
    test::expectSound(*done, linker, recorded.name);
    // No link takes a way round a limb.
    const std::vector<ModelPoint>& data = test::curveOf(*done, "line").dataPoints;
    for (std::size_t i = 0; i + 1 < data.size(); ++i) {
      const SurfacePoint a = *toSurfacePoint(mesh, data[i]), b = *toSurfacePoint(mesh, data[i + 1]);
      const double straight = (placeOf(body, a) - placeOf(body, b)).norm();
      EXPECT_LT(length(mesh, *linker.link(a, b)), 1.5 * straight + mesh.meanEdgeLength())
          << recorded.name;
    }
  }
}

}  // namespace
}  // namespace toile
