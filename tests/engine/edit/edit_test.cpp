// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/edit_support.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/edit/draw.h"
#include "toile/edit/fair.h"
#include "toile/edit/lines.h"
#include "toile/edit/measure.h"
#include "toile/edit/shape.h"
#include "toile/edit/symmetry.h"
#include "toile/shape/builtin.h"

namespace toile {
namespace {

using Eigen::Vector3d;

Document torso() {
  return test::documentOn("builtin:torso@1");
}
using test::curveOf;
using test::near;
using test::pathOf;
using test::placeOf;

/// A line down the left front of the torso, by five points.
Document withLine(const Document& document, const std::string& id = "line") {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 5; ++i) {
    const double z = 0.35 + 0.1 * i;
    const Vector3d low = document.model->mesh->boxMin(), high = document.model->mesh->boxMax();
    points.push_back(near(document, {60, low.y() - 50, low.z() + z * (high.z() - low.z())}));
  }
  const auto drawn = drawThrough(document, points, false, {id, "", CurveKind::Seam});
  EXPECT_TRUE(drawn) << drawn.error();
  return drawn->document;
}
TEST(Drag, LeavesTheRestBitForBitAndKeepsTangents) {
  const Document before = withLine(torso());
  const auto all5 = handlesOf(before, "line");
  ASSERT_TRUE(all5) << all5.error();
  ASSERT_EQ(all5->size(), 5U);
  const Stretch stretch{0.4 * (*all5)[1].at + 0.6 * (*all5)[2].at,
                        0.6 * (*all5)[2].at + 0.4 * (*all5)[3].at};
  const auto handles = handlesOf(before, "line", stretch);
  ASSERT_TRUE(handles) << handles.error();
  ASSERT_EQ(handles->size(), 1U);  // the middle control point
  EXPECT_TRUE((*handles)[0].isControl);
  auto drag = CurveDrag::begin(before, "line", stretch, 0);
  ASSERT_TRUE(drag) << drag.error();
  const Vector3d start = placeOf(before, (*handles)[0].point);
  ASSERT_TRUE(drag->moveTo(start + Vector3d(30, -5, 10)));
  const auto after = drag->document();
  ASSERT_TRUE(after) << after.error();
  EXPECT_GT((placeOf(before, drag->handle()) - start).norm(), 20);
  const auto& old = curveOf(before, "line").dataPoints;
  const auto& made = curveOf(*after, "line").dataPoints;
  std::size_t same = 0, sameBack = 0;
  while (old[same] == made[same]) ++same;
  while (old[old.size() - 1 - sameBack] == made[made.size() - 1 - sameBack]) ++sameBack;
  EXPECT_GE(same + sameBack, old.size() / 2);
  EXPECT_LT(same + sameBack, old.size());
  // The direction at the ends of the stretch stays: no kink there.
  const Mesh& mesh = *before.model->mesh;
  const SurfacePath path = pathOf(*after, "line");
  const double all = length(mesh, path);
  const SurfacePoint join = *toSurfacePoint(mesh, made[same - 1]);
  double arc = 0;
  for (std::size_t i = 0; i + 1 < path.points.size() && !(path.points[i] == join); ++i) {
    arc += (position(mesh, path.points[i + 1]) - position(mesh, path.points[i])).norm();
  }
  const auto at = [&](double s) { return position(mesh, pointAtFraction(mesh, path, s / all)); };
  const Vector3d in = (at(arc) - at(arc - 3)).normalized(),
                 out = (at(arc + 3) - at(arc)).normalized();
  EXPECT_GT(in.dot(out), std::cos(0.15));
  // Back again is the old curve; not moving changes nothing at all.
  ASSERT_TRUE(drag->moveOnto((*handles)[0].point));
  EXPECT_EQ(curveOf(*drag->document(), "line").dataPoints, old);
}

TEST(Drag, GivesEvenSamplesWhereThereAreNoControls) {
  const Document document = torso();
  const auto girth = drawGirth(document, near(document, {0, -500, 1000}), {0, 0, 1},
                               {"girth", "", CurveKind::Seam});
  ASSERT_TRUE(girth) << girth.error();
  for (const Stretch stretch : {Stretch{0.1, 0.4}, Stretch{0.8, 0.2}, Stretch{0, 1}}) {
    const auto handles = handlesOf(girth->document, "girth", stretch);
    ASSERT_TRUE(handles) << handles.error();
    EXPECT_GE(handles->size(), 4U);
    EXPECT_LE(handles->size(), 6U);
    for (std::size_t h = 0; h < handles->size(); ++h) {
      const SurfacePoint to =
          near(document, placeOf(document, (*handles)[h].point) + Vector3d(0, 0, 25));
      const auto moved = moveHandle(girth->document, "girth", stretch, h, to);
      ASSERT_TRUE(moved) << moved.error();
      const SurfacePath path = pathOf(*moved, "girth");
      EXPECT_TRUE(path.closed);
      EXPECT_TRUE(std::find(path.points.begin(), path.points.end(), to) != path.points.end());
    }
  }
}

TEST(Network, CrossingsStaySharedWhenALineMoves) {
  const Document line = withLine(torso());
  const Vector3d middle =
      placeOf(line, pointAtFraction(*line.model->mesh, pathOf(line, "line"), 0.45));
  const auto ring = drawGirth(line, near(line, middle), {0, 0, 1}, {"ring", "", CurveKind::Seam});
  ASSERT_TRUE(ring) << ring.error();
  const auto shared = shareCrossings(ring->document);
  ASSERT_TRUE(shared) << shared.error();
  const auto common = [](const Document& document) {
    std::size_t count = 0;
    for (const ModelPoint& p : curveOf(document, "line").dataPoints) {
      const auto& data = curveOf(document, "ring").dataPoints;
      count += std::find(data.begin(), data.end(), p) != data.end();
    }
    return count;
  };
  EXPECT_EQ(common(shared->document), 1U);
  const auto handles = handlesOf(shared->document, "line");
  ASSERT_TRUE(handles) << handles.error();
  const SurfacePoint to = near(line, placeOf(line, (*handles)[2].point) + Vector3d(30, 0, 5));
  const auto moved = moveHandle(shared->document, "line", {}, 2, to);
  ASSERT_TRUE(moved) << moved.error();
  EXPECT_GE(common(*moved), 1U);
  const auto meetings = meetingsOf(*moved, "line", "ring");
  ASSERT_TRUE(meetings) << meetings.error();
  ASSERT_EQ(meetings->size(), 1U);
  const auto& data = curveOf(*moved, "ring").dataPoints;
  EXPECT_TRUE(std::find(data.begin(), data.end(),
                        toModelPoint(*line.model->mesh, (*meetings)[0].point)) != data.end());
  EXPECT_GT((*meetings)[0].angle.degrees(), 20);
}

TEST(Mirror, OfTheMirrorIsTheOriginalAndLinksFollow) {
  const Document line = withLine(torso(), "front_l");
  const std::vector<std::string> one{"front_l"}, image{"front_r"};
  const auto once = mirrorCurves(line, one, false);
  ASSERT_TRUE(once) << once.error();
  ASSERT_EQ(once->curves, image);
  const auto twice = mirrorCurves(once->document, image, false);
  ASSERT_TRUE(twice) << twice.error();
  const auto& original = curveOf(line, "front_l").dataPoints;
  const auto& back = curveOf(twice->document, twice->curves[0]).dataPoints;
  ASSERT_EQ(original.size(), back.size());
  for (std::size_t i = 0; i < original.size(); ++i) {
    EXPECT_LT((placeOf(line, *toSurfacePoint(*line.model->mesh, original[i])) -
               placeOf(line, *toSurfacePoint(*line.model->mesh, back[i])))
                  .norm(),
              1e-9);
  }
  // Linked: dragging the image moves the original.
  const auto linked = mirrorCurves(line, one, true);
  ASSERT_TRUE(linked) << linked.error();
  const auto handles = handlesOf(linked->document, "front_r");
  ASSERT_TRUE(handles) << handles.error();
  const SurfacePoint to = near(line, placeOf(line, (*handles)[2].point) + Vector3d(-25, 0, 0));
  const auto moved = moveHandle(linked->document, "front_r", {}, 2, to);
  ASSERT_TRUE(moved) << moved.error();
  EXPECT_NE(curveOf(*moved, "front_l").dataPoints, original);
  const SurfacePath l = pathOf(*moved, "front_l"), r = pathOf(*moved, "front_r");
  ASSERT_EQ(l.points.size(), r.points.size());
  for (std::size_t i = 0; i < l.points.size(); ++i) {
    const Vector3d a = placeOf(line, l.points[i]), b = placeOf(line, r.points[i]);
    EXPECT_LT((a - Vector3d(-b.x(), b.y(), b.z())).norm(), 1e-9);
  }
  const auto unlinked = unlinkMirror(*moved, "front_r");
  ASSERT_TRUE(unlinked) << unlinked.error();
  EXPECT_FALSE(curveOf(*unlinked, "front_r").mirrorOf);
}

TEST(Mirror, HalvesJoinSmoothlyOnTheMiddle) {
  const Document document = torso();
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 5; ++i) {  // slanting over the middle of the front
    points.push_back(near(document, {-80.0 + 40 * i, -500, 1000.0 + 15 * i}));
  }
  const auto drawn = drawThrough(document, points, false, {"yoke", "", CurveKind::Seam});
  ASSERT_TRUE(drawn) << drawn.error();
  const auto made = makeSymmetric(drawn->document, "yoke", Side::Left);
  ASSERT_TRUE(made) << made.error();
  const SurfacePath half = pathOf(made->document, "yoke"),
                    other = pathOf(made->document, made->curves[1]);
  EXPECT_EQ(half.points.front(), other.points.front());
  EXPECT_NEAR(placeOf(document, half.points.front()).x(), 0, 1e-9);
  // Square to the middle within a few degrees over the first millimetres.
  const Mesh& mesh = *document.model->mesh;
  const Vector3d step = position(mesh, pointAtFraction(mesh, half, 4 / length(mesh, half))) -
                        position(mesh, half.points.front());
  // Drawn, it rose by 15 mm in 40.
  EXPECT_LT(std::abs(step.normalized().z()), 0.1);
}

TEST(Lines, SplitJoinTrimExtendEraseAndOffset) {
  const Document line = withLine(torso());
  const double all = curveLength(line, "line")->mm();
  const auto parts = splitCurve(line, "line", std::vector<double>{0.25, 0.6});
  ASSERT_TRUE(parts) << parts.error();
  ASSERT_EQ(parts->curves.size(), 3U);
  double sum = 0;
  for (const std::string& id : parts->curves) sum += curveLength(parts->document, id)->mm();
  EXPECT_NEAR(sum, all, 1e-9 * all);
  const auto joined = joinCurves(parts->document, "line", parts->curves[1]);
  ASSERT_TRUE(joined) << joined.error();
  EXPECT_NEAR(curveLength(*joined, "line")->mm(), 0.6 * all, 1e-6 * all);

  // A dart hangs on the part that holds its place.
  const SurfacePoint apex = near(line, {130, -500, 1000});
  const auto dart = drawDart(line, "line", apex, 0.7);
  ASSERT_TRUE(dart) << dart.error();
  const SurfacePoint foot = pathOf(dart->document, dart->curves[0]).points.front();
  const auto split = splitCurve(dart->document, "line", std::vector<double>{0.5});
  ASSERT_TRUE(split) << split.error();
  EXPECT_LT(
      (placeOf(line, pathOf(split->document, dart->curves[0]).points.front()) - placeOf(line, foot))
          .norm(),
      1e-6);
  const auto removed = removeCurve(dart->document, "line");
  ASSERT_TRUE(removed) << removed.error();
  EXPECT_LT((placeOf(line, pathOf(*removed, dart->curves[0]).points.front()) - placeOf(line, foot))
                .norm(),
            1e-9);

  const SurfacePoint at = pointAtFraction(*line.model->mesh, pathOf(line, "line"), 0.5);
  const auto ring = drawGirth(line, at, {0, 0, 1}, {"ring", "", CurveKind::Seam});
  ASSERT_TRUE(ring) << ring.error();
  const std::vector<std::string> rings{"ring"};
  const auto trimmed = trimAtCrossings(ring->document, "line", 0.9, rings);
  ASSERT_TRUE(trimmed) << trimmed.error();
  EXPECT_NEAR(curveLength(trimmed->document, "line")->mm(), 0.5 * all, 0.01 * all);
  const auto shorter = eraseStretch(trimmed->document, "line", {0.8, 1});
  ASSERT_TRUE(shorter) << shorter.error();
  const auto extended = extendToCurve(shorter->document, "line", CurveEnd::End, "ring");
  ASSERT_TRUE(extended) << extended.error();
  EXPECT_EQ(meetingsOf(*extended, "line", "ring")->size(), 1U);

  const auto beside = offsetCurve(line, "line", Length::mm(15));
  ASSERT_TRUE(beside) << beside.error();
  const SurfacePath path = pathOf(line, "line"),
                    parallel = pathOf(beside->document, beside->curves[0]);
  const Mesh& mesh = *line.model->mesh;
  for (int i = 1; i < 10; ++i) {
    const SurfacePoint p = pointAtFraction(mesh, parallel, i / 10.0);
    double nearest = 1e9;
    for (int k = 0; k <= 200; ++k) {
      nearest = std::min(
          nearest,
          (position(mesh, pointAtFraction(mesh, path, k / 200.0)) - position(mesh, p)).norm());
    }
    EXPECT_NEAR(nearest, 15, 0.6);
  }
}

TEST(Pencil, IsCutAtTheSilhouetteAndSaysSo) {
  const Document document = torso();
  View view;
  view.eye = {0, -3000, 1000};
  view.target = {0, 0, 1000};
  std::vector<StrokeSample> stroke;
  for (int i = 0; i <= 200; ++i)
    stroke.push_back({{-60.0 + 3 * i, 20 * std::sin(0.03 * i)}, 0.01 * i, 1});
  const auto drawn = drawStroke(document, view, stroke);
  ASSERT_TRUE(drawn) << drawn.error();
  ASSERT_EQ(drawn->curves.size(), 1U);
  ASSERT_FALSE(drawn->findings.empty());
  EXPECT_EQ(drawn->findings[0].code, "cut-at-silhouette");
  const SurfacePath path = pathOf(drawn->document, drawn->curves[0]);
  EXPECT_LT(length(*document.model->mesh, path), 600);
  // On with it from the side, and a part of it anew.
  std::vector<StrokeSample> over;
  for (int i = 0; i <= 60; ++i) over.push_back({{-20.0 + i, 10 + 15 * std::sin(0.05 * i)}, 0, 1});
  const auto again = drawOver(drawn->document, drawn->curves[0], view, over);
  ASSERT_TRUE(again) << again.error();
  EXPECT_NE(curveOf(again->document, drawn->curves[0]).dataPoints,
            curveOf(drawn->document, drawn->curves[0]).dataPoints);
  std::vector<StrokeSample> on;
  for (int i = 0; i <= 30; ++i) on.push_back({{-65.0 - i, -0.5 * i}, 0, 1});
  const auto longer = continueStroke(again->document, drawn->curves[0], view, on);
  ASSERT_TRUE(longer) << longer.error();
  EXPECT_GT(curveLength(longer->document, drawn->curves[0])->mm(),
            curveLength(again->document, drawn->curves[0])->mm() + 20);
}

TEST(Edit, RefusesWhatCannotBeDone) {
  const Document document = torso(), line = withLine(document);
  const SurfacePoint p = near(document, {0, -500, 1000}), q = near(document, {50, -500, 1000});
  const std::vector<SurfacePoint> same{p, p}, two{p, q}, off{p, {VertexId(99999999)}};
  const auto code = [](const auto& result) {
    EXPECT_FALSE(result);
    return result ? ErrorCode::Cancelled : result.error().code;
  };
  EXPECT_EQ(code(drawThrough(document, same, false)), ErrorCode::CurveInvalid);
  EXPECT_EQ(code(drawThrough(document, two, true)), ErrorCode::CurveInvalid);
  EXPECT_EQ(code(drawThrough(document, off, false)), ErrorCode::CurveInvalid);
  EXPECT_EQ(code(drawStroke(document, View{}, std::vector<StrokeSample>{{{0, 0}, 0, 1}})),
            ErrorCode::CurveInvalid);
  EXPECT_EQ(code(handlesOf(line, "lin")), ErrorCode::NameNotFound);
  EXPECT_EQ(code(moveHandle(line, "line", {}, 99, p)), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(moveHandle(line, "line", {0.5, 0.5}, 0, p)), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(splitCurve(line, "line", std::vector<double>{2})), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(offsetCurve(line, "line", Length())), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(unlinkMirror(line, "line")), ErrorCode::CurveInvalid);
  const auto taken = drawThrough(line, two, false, {"line", "", CurveKind::Seam});
  EXPECT_EQ(code(taken), ErrorCode::CurveInvalid);
  // A thousand points are a curve.
  std::vector<SurfacePoint> thousand;
  for (int i = 0; i < 1000; ++i) {
    const SurfacePoint next = near(document, {40 * std::sin(0.05 * i), -500, 1000 + 0.1 * i});
    if (thousand.empty() ||
        (placeOf(document, next) - placeOf(document, thousand.back())).norm() > 1e-3) {
      thousand.push_back(next);
    }
  }
  const auto tortuous = drawThrough(document, thousand, false);
  EXPECT_TRUE(tortuous) << tortuous.error();
  // Through one face again and again.
  const FaceId face = std::get<SurfacePoint::InFace>(
                          makeSurfacePoint(*document.model->mesh, FaceId(500), {1, 1, 1}).at)
                          .face;
  std::vector<SurfacePoint> zigzag;
  for (int i = 0; i < 20; ++i) {
    zigzag.push_back(makeSurfacePoint(*document.model->mesh, face,
                                      {1.0 + i, i % 2 == 0 ? 4.0 : 12.0, 20.0 - i}));
  }
  const auto tangled = drawShortest(document, zigzag);
  ASSERT_TRUE(tangled) << tangled.error();
  EXPECT_TRUE(shareCrossings(tangled->document));
}

// Cursor paths as a hand would take them; the handle stays on its limb.
TEST(Drag, StaysOnItsLimbOnABody) {
  TOILE_TEST_DATA_OR_SKIP(file, "bodies/female_average.ply");
  const Result<ReferenceModel> model = readModel(file, FileUnit::Millimetre);
  ASSERT_TRUE(model) << model.error();
  const Document document{std::make_shared<const Design>(),
                          std::make_shared<const ReferenceModel>(*model)};
  struct Recorded {
    const char* name;
    Vector3d start, normal;     ///< of the girth that is pulled
    std::vector<Vector3d> way;  ///< of the cursor, relative to the handle
    double leastX, mostX;       ///< where the limb is
  };
  // The left leg stands at x > 0; between the legs x = 0. The left arm is beyond the torso.
  const std::vector<Recorded> paths{
      {"between the thighs",
       {90, -300, 650},
       {0, 0, 1},
       {{-40, 0, 0}, {-90, 10, 0}, {-150, 30, 10}, {-220, 20, 0}},
       0,
       400},
      {"behind the thigh",
       {90, 300, 600},
       {0, 0, 1},
       {{-60, 10, 20}, {-140, 0, 20}, {-260, -10, 0}},
       0,
       400},
  };
  for (const Recorded& recorded : paths) {
    const SurfacePoint start = near(document, recorded.start);
    const auto girth = drawGirth(document, start, recorded.normal, {"girth", "", CurveKind::Seam});
    ASSERT_TRUE(girth) << girth.error();
    const auto handles = handlesOf(girth->document, "girth");
    ASSERT_TRUE(handles) << handles.error();
    for (std::size_t h = 0; h < handles->size(); ++h) {
      auto drag = CurveDrag::begin(girth->document, "girth", {}, h);
      ASSERT_TRUE(drag) << drag.error();
      const Vector3d from = placeOf(document, (*handles)[h].point);
      for (const Vector3d& by : recorded.way) {
        const Result<void> moved = drag->moveTo(from + by);
        ASSERT_TRUE(moved) << recorded.name << moved.error();
        for (const SurfacePoint& point : drag->path().points) {
          const double x = placeOf(document, point).x();
          EXPECT_GT(x, recorded.leastX - 1) << recorded.name;
          EXPECT_LT(x, recorded.mostX) << recorded.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace toile
