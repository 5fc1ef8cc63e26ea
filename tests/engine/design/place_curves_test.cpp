// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/curve/geodesic.h"
#include "toile/design/design.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

ReferenceModel modelOf(Mesh mesh) {
  ReferenceModel model;
  model.name = "made up";
  model.reference = "builtin:made-up";
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.index = std::make_shared<const SurfaceIndex>(model.mesh);
  return model;
}

/// A tube around z, radius 60, 300 high, with a ring, a line and two landmarks.
ReferenceModel tube() {
  constexpr int kSegments = 24, kRows = 20;
  ReferenceModel model = modelOf(test::cylinder(60, 300, kSegments, kRows));
  const Mesh& mesh = *model.mesh;
  GeodesicLinker linker(model.mesh);
  const auto at = [](int i, int j) {
    return SurfacePoint{VertexId(static_cast<std::size_t>(j * kSegments + i % kSegments))};
  };
  std::vector<SurfacePoint> ring;
  for (int i = 0; i < kSegments; ++i) ring.push_back(at(i, 10));
  model.curves["ring"] = *linker.linkAll(ring, true);
  model.curves["line"] = *linker.link(at(0, 0), at(0, kRows));
  model.landmarks["low"] = at(6, 4);
  model.landmarks["high"] = at(9, 16);
  VertexData<VertexId> partner(mesh.vertexCount());
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i < kSegments; ++i) {
      partner[std::get<VertexId>(at(i, j).at)] =
          std::get<VertexId>(at((kSegments - i) % kSegments, j).at);
    }
  }
  model.symmetry = Symmetry{{0, 1, 0}, 0, partner};
  return model;
}

StylingCurve curve(std::string id, CurveWay way, bool closed = false) {
  StylingCurve made;
  made.id = std::move(id);
  made.way = std::move(way);
  made.closed = closed;
  return made;
}

Place near(double x, double y, double z) {
  return NearPosition{{x, y, z}};
}

Place around(double angle, double z) {
  return near(60 * std::cos(angle), 60 * std::sin(angle), z);
}

std::vector<PlacedCurve> placed(const Design& design, const ReferenceModel& model) {
  Result<std::vector<PlacedCurve>> curves = placeCurves(design, model);
  EXPECT_TRUE(curves) << curves.error();
  if (!curves) return {};
  EXPECT_EQ(curves->size(), design.curves.size());
  for (const PlacedCurve& c : *curves) {
    EXPECT_TRUE(isValid(*model.mesh, c.path)) << c.id;
    // Every data point is a point of the path, in order.
    std::size_t found = 0;
    for (const SurfacePoint& p : c.path.points) {
      if (found < c.dataPoints.size() && p == c.dataPoints[found]) ++found;
    }
    EXPECT_EQ(found, c.dataPoints.size()) << c.id;
  }
  return *std::move(curves);
}

PlacedCurve placeOne(const ReferenceModel& model, StylingCurve made) {
  Design design;
  design.curves.push_back(std::move(made));
  std::vector<PlacedCurve> curves = placed(design, model);
  return curves.empty() ? PlacedCurve() : curves.front();
}

Error refused(const ReferenceModel& model, std::vector<StylingCurve> curves) {
  Design design;
  design.curves = std::move(curves);
  const Result<std::vector<PlacedCurve>> result = placeCurves(design, model);
  EXPECT_FALSE(result);
  return result ? Error() : result.error();
}

TEST(ResolvePlace, KnowsEveryKindOfPlace) {
  const ReferenceModel model = tube();
  const Mesh& mesh = *model.mesh;
  const auto resolve = [&](const Place& place) {
    const Result<SurfacePoint> point = resolvePlace(place, model, {});
    EXPECT_TRUE(point) << point.error();
    return point ? *point : SurfacePoint();
  };
  EXPECT_EQ(resolve(ModelPoint{VertexId(7)}), SurfacePoint{VertexId(7)});
  EXPECT_EQ(resolve(AtLandmark{"low", {}}), model.landmarks.at("low"));
  EXPECT_LT((position(mesh, resolve(OnModelCurve{"line", 0.25, {}})) - Vector3d(60, 0, 75)).norm(),
            1e-9);
  const SurfacePoint low = resolve(NearPosition{{100, 0, 33}, {}});
  EXPECT_LT((position(mesh, low) - Vector3d(60, 0, 33)).norm(), 1e-9);

  // The section at 100 mm is a regular polygon; its farthest point along +x is the vertex there.
  OnSection section;
  section.plane.through = Length::mm(100);
  section.direction = {1, 0, 0};
  EXPECT_LT((position(mesh, resolve(section)) - Vector3d(60, 0, 100)).norm(), 1e-9);
  section.plane.through = AtLandmark{"high", {}};
  section.direction = {0, -3, 5};  // only what lies in the plane counts
  EXPECT_LT((position(mesh, resolve(section)) - Vector3d(0, -60, 240)).norm(), 1e-9);
}

TEST(ResolvePlace, GoesTheShortestWayBetweenTwoPlaces) {
  const ReferenceModel model = tube();
  const Mesh& mesh = *model.mesh;
  const auto resolve = [&](const Place& place) {
    const Result<SurfacePoint> point = resolvePlace(place, model, {});
    EXPECT_TRUE(point) << point.error();
    return point ? *point : SurfacePoint();
  };
  const NearPosition low{{60, 0, 33}, {}};
  const NearPosition high{{60, 0, 93}, {}};
  EXPECT_LT(
      (position(mesh, resolve(BetweenPlaces{{low, high}, 0.25, {}})) - Vector3d(60, 0, 48)).norm(),
      1e-9);
  EXPECT_EQ(resolve(BetweenPlaces{{low, high}, 0, {}}), resolve(low));
  EXPECT_EQ(resolve(BetweenPlaces{{low, low}, 0.5, {}}), resolve(low));
  const Result<SurfacePoint> wrong =
      resolvePlace(BetweenPlaces{{low, AtLandmark{"lwo", {}}}, 0.5, {}}, model, {});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::NameNotFound);
}

TEST(ResolvePlace, RefusesWhatIsNotThere) {
  const ReferenceModel model = tube();
  const auto error = [&](const Place& place) {
    const Result<SurfacePoint> point = resolvePlace(place, model, {});
    EXPECT_FALSE(point);
    return point ? Error() : point.error();
  };
  EXPECT_EQ(error(AtLandmark{"lwo", {}}).code, ErrorCode::NameNotFound);
  EXPECT_NE(error(AtLandmark{"lwo", {}}).message.find("did you mean \"low\""), std::string::npos);
  EXPECT_EQ(error(OnModelCurve{"rnig", 0, {}}).code, ErrorCode::NameNotFound);
  EXPECT_EQ(error(OnModelCurve{"ring", 1.5, {}}).code, ErrorCode::InvalidArgument);
  EXPECT_EQ(error(OnStylingCurve{"none", 0, {}}).code, ErrorCode::NameNotFound);
  EXPECT_EQ(error(ModelPoint{VertexId(99999)}).code, ErrorCode::ModelMismatch);
  OnSection section;
  section.plane.through = Length::mm(5000);
  EXPECT_EQ(error(section).code, ErrorCode::CurveInvalid);
  section.plane.through = Length::mm(100);
  section.direction = {0, 0, 1};
  EXPECT_EQ(error(section).code, ErrorCode::InvalidArgument);
  EXPECT_EQ(error(near(NAN, 0, 0)).code, ErrorCode::InvalidArgument);
}

TEST(PlaceCurves, PutsASmoothCurveThroughItsControls) {
  const ReferenceModel model = tube();
  const Mesh& mesh = *model.mesh;
  SmoothWay way;
  for (int i = 0; i < 7; ++i) way.controls.push_back(around(0.35 * i, 60 + 25 * i));
  const PlacedCurve helix = placeOne(model, curve("helix", way));
  EXPECT_EQ(helix.dataPoints.size(), 8U * 6 + 1);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(helix.dataPoints[8 * i], *resolvePlace(way.controls[i], model, {}));
  }
  // About as long as the helix of the round tube.
  EXPECT_NEAR(length(mesh, helix.path) / std::hypot(0.35 * 6 * 60, 150), 1, 0.01);
  for (const SurfacePoint& p : helix.path.points) {
    const Vector3d at = position(mesh, p);
    EXPECT_NEAR(std::hypot(at.x(), at.y()), 60, 0.6);
  }
}

TEST(PlaceCurves, ClosesASmoothCurve) {
  const ReferenceModel model = tube();
  SmoothWay way;
  for (int i = 0; i < 6; ++i) way.controls.push_back(around(pi / 3 * i, 150 + 20 * (i % 2)));
  const PlacedCurve girth = placeOne(model, curve("girth", way, true));
  EXPECT_TRUE(girth.path.closed);
  EXPECT_EQ(girth.dataPoints.size(), 48U);
}

TEST(PlaceCurves, JoinsCurvesExactly) {
  const ReferenceModel model = tube();
  Design design;
  // Listed before what it hangs on.
  SmoothWay between;
  between.controls = {OnStylingCurve{"upper", 0.4, {}}, around(0.9, 140),
                      OnModelCurve{"ring", 0.02, {}}};
  design.curves.push_back(curve("between", between));
  SmoothWay upper;
  upper.controls = {around(0.1, 250), around(0.8, 260), around(1.6, 245)};
  design.curves.push_back(curve("upper", upper));
  const auto curves = placed(design, model);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].id, "between");
  EXPECT_EQ(curves[0].path.points.front(), pointAtFraction(*model.mesh, curves[1].path, 0.4));
  EXPECT_EQ(curves[0].path.points.back(),
            pointAtFraction(*model.mesh, model.curves.at("ring"), 0.02));
}

TEST(PlaceCurves, TakesStretchesOfModelCurvesAsTheyAre) {
  const ReferenceModel model = tube();
  const Mesh& mesh = *model.mesh;
  const PlacedCurve whole = placeOne(model, curve("ring", AlongModelCurve{"ring", 0, 1, {}}, true));
  EXPECT_TRUE(whole.path.closed);
  EXPECT_EQ(whole.path.points, model.curves.at("ring").points);
  const PlacedCurve part = placeOne(model, curve("part", AlongModelCurve{"line", 0.75, 0.25, {}}));
  EXPECT_NEAR(length(mesh, part.path), 150, 1e-9);
  EXPECT_NEAR(position(mesh, part.path.points.front()).z(), 225, 1e-9);
  const PlacedCurve wrapped =
      placeOne(model, curve("wrapped", AlongModelCurve{"ring", 0.9, 0.1, {}}));
  EXPECT_NEAR(length(mesh, wrapped.path), 0.2 * length(mesh, model.curves.at("ring")), 1e-9);
}

TEST(PlaceCurves, FollowsVerticesSectionsAndTheShortestWay) {
  const ReferenceModel model = tube();
  const Mesh& mesh = *model.mesh;
  const PlacedCurve edges = placeOne(
      model,
      curve("edges", AlongVertices{{VertexId(0), VertexId(1), VertexId(2), VertexId(50)}, {}}));
  EXPECT_EQ(edges.dataPoints.size(), 4U);

  AlongSection girth;
  girth.plane.through = Length::mm(155);
  const PlacedCurve section = placeOne(model, curve("section", girth, true));
  EXPECT_TRUE(section.path.closed);
  EXPECT_NEAR(length(mesh, section.path), 24 * 120 * std::sin(pi / 24), 1e-9);
  // It starts at the front and runs counter-clockwise about the normal.
  EXPECT_LT((position(mesh, section.path.points[0]) - Vector3d(0, -60, 155)).norm(), 1e-9);
  EXPECT_GT(position(mesh, section.path.points[1]).x(), 0);

  ShortestWay way;
  way.controls = {AtLandmark{"low", {}}, AtLandmark{"high", {}}};
  const PlacedCurve link = placeOne(model, curve("link", way));
  EXPECT_NEAR(length(mesh, link.path), std::hypot(3 * 120 * std::sin(pi / 24), 180), 1e-9);
  EXPECT_LE(geodesicDefect(mesh, link.path), 1e-9);
}

TEST(PlaceCurves, ProjectsADrawing) {
  const ReferenceModel model = tube();
  ViewWay way;
  way.view = {{0, -2000, 150}, {0, 0, 150}, {0, 0, 1}, 400, false};
  way.controls = {{-30, -80}, {0, 0}, {30, 70}};
  const PlacedCurve drawn = placeOne(model, curve("drawn", way));
  EXPECT_EQ(drawn.dataPoints.size(), 17U);
  EXPECT_NEAR(position(*model.mesh, drawn.dataPoints[8]).x(), 0, 1e-9);
  way.controls.push_back({200, 70});
  const Error error = refused(model, {curve("wide", way)});
  EXPECT_EQ(error.code, ErrorCode::LeavesSilhouette);
  EXPECT_NE(error.message.find("curve \"wide\""), std::string::npos);
  ASSERT_FALSE(error.where.empty());
  EXPECT_EQ(error.where.front(), Element::curve("wide"));
}

TEST(PlaceCurves, MirrorsExactly) {
  const ReferenceModel model = tube();
  const Mesh& mesh = *model.mesh;
  Design design;
  StylingCurve image = curve("right", SmoothWay());
  image.mirrorOf = "left";
  design.curves.push_back(image);
  SmoothWay way;
  way.controls = {around(0.3, 50), around(0.9, 120), around(1.4, 230)};
  design.curves.push_back(curve("left", way));
  const auto curves = placed(design, model);
  ASSERT_EQ(curves.size(), 2U);
  const PlacedCurve &right = curves[0], &left = curves[1];
  ASSERT_EQ(right.path.points.size(), left.path.points.size());
  for (std::size_t i = 0; i < right.path.points.size(); ++i) {
    const Vector3d p = position(mesh, left.path.points[i]);
    const Vector3d q = position(mesh, right.path.points[i]);
    EXPECT_LT((Vector3d(p.x(), -p.y(), p.z()) - q).norm(), 1e-9);
  }
  ReferenceModel lopsided = model;
  lopsided.symmetry.reset();
  const Result<std::vector<PlacedCurve>> result = placeCurves(design, lopsided);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::CurveInvalid);
}

TEST(PlaceCurves, UsesDataPointsBeforeTheWay) {
  const ReferenceModel model = tube();
  SmoothWay way;
  way.controls = {around(0.3, 50), around(0.9, 120), around(1.4, 230)};
  const PlacedCurve first = placeOne(model, curve("c", way));
  StylingCurve stored = curve("c", ShortestWay());
  for (const SurfacePoint& p : first.dataPoints) {
    stored.dataPoints.push_back(toModelPoint(*model.mesh, p));
  }
  EXPECT_EQ(placeOne(model, stored).path.points, first.path.points);
  // On a body of the same connectivity and another shape they are the same places.
  const ReferenceModel wider =
      modelOf(test::transformed(*model.mesh, Vector3d(2, 1, 1).asDiagonal(), {0, 0, 5}));
  EXPECT_EQ(placeOne(wider, stored).dataPoints, first.dataPoints);
}

/// A sheet rolled around z at radius 50, turned back on itself at 240 degrees and led home at
/// radius 46; 5 degrees a column.
Mesh hairpin() {
  constexpr int kArc = 48, kTurn = 4, kRows = 20;
  const Mesh flat = test::grid(2 * kArc + kTurn, kRows, 5);
  std::vector<Vector3d> positions;
  for (const Vector3d& p : flat.positions()) {
    const int i = static_cast<int>(std::lround(p.x() / 5));
    const double turned = pi * std::clamp(i - kArc, 0, kTurn) / kTurn;
    const double angle = pi / 36 * std::min({i, kArc, 2 * kArc + kTurn - i});
    const double radius = 48 + 2 * std::cos(turned), along = 2 * std::sin(turned);
    positions.emplace_back(radius * std::cos(angle) - along * std::sin(angle),
                           radius * std::sin(angle) + along * std::cos(angle), p.y());
  }
  return flat.withPositions(positions);
}

// Two layers closer to each other than the curve's chords are to its own: it stays on its own.
TEST(PlaceCurves, StaysOnItsLayer) {
  const ReferenceModel model = modelOf(hairpin());
  const Mesh& mesh = *model.mesh;
  SmoothWay way;
  std::vector<Vector3d> places;
  for (const std::size_t column : {4U, 16U, 28U, 40U}) {
    const VertexId v(10 * 101 + column);
    way.controls.push_back(ModelPoint{v});
    places.push_back(mesh.position(v));
  }
  // The trap is real: the plain closest point of the first middle lies on the inner layer.
  const std::vector<Vector3d> fine = subdivide<3>(places, false, SubdivisionRule::Auto);
  const Vector3d plain = model.index->closestPoint(fine[4]).position;
  ASSERT_LT(std::hypot(plain.x(), plain.y()), 47);

  const PlacedCurve girth = placeOne(model, curve("girth", way));
  for (const SurfacePoint& p : girth.path.points) {
    const Vector3d at = position(mesh, p);
    EXPECT_GT(std::hypot(at.x(), at.y()), 49);
  }
}

TEST(PlaceCurves, RefusesWhatCannotBeMeant) {
  const ReferenceModel model = tube();
  const auto hanging = [](std::string id, std::string on) {
    SmoothWay way;
    way.controls = {OnStylingCurve{std::move(on), 0.5, {}}, near(60, 0, 10)};
    return curve(std::move(id), way);
  };
  const Error circle = refused(model, {hanging("a", "b"), hanging("b", "c"), hanging("c", "a")});
  EXPECT_EQ(circle.code, ErrorCode::CurveInvalid);
  EXPECT_NE(circle.message.find("circle"), std::string::npos) << circle.message;
  EXPECT_EQ(circle.where.size(), 3U);
  EXPECT_EQ(refused(model, {hanging("a", "a")}).code, ErrorCode::CurveInvalid);
  EXPECT_EQ(refused(model, {hanging("a", "missing")}).code, ErrorCode::NameNotFound);

  SmoothWay two;
  two.controls = {near(60, 0, 10), near(60, 0, 10)};
  EXPECT_EQ(refused(model, {curve("same", two)}).code, ErrorCode::CurveInvalid);
  SmoothWay one;
  one.controls = {near(60, 0, 10)};
  EXPECT_EQ(refused(model, {curve("one", one)}).code, ErrorCode::CurveInvalid);
  EXPECT_EQ(refused(model, {curve("r", AlongModelCurve{"ring", 0.5, 0.5, {}})}).code,
            ErrorCode::InvalidArgument);
  EXPECT_EQ(refused(model, {curve("r", AlongModelCurve{"line", 0, 1, {}}, true)}).code,
            ErrorCode::CurveInvalid);
  ShortestWay twice;
  twice.controls = {near(60, 0, 10), near(60, 0, 90)};
  const Error same = refused(model, {curve("x", twice), curve("x", twice)});
  EXPECT_EQ(same.code, ErrorCode::CurveInvalid);
}

TEST(PlaceCurves, RefusesADesignForAnotherConnectivity) {
  const ReferenceModel model = tube();
  Design design;
  design.name = "shirt";
  ModelReference drawnOn;
  drawnOn.reference = "other.ply";
  drawnOn.connectivityHash = test::icosphere(10, 1).connectivityHash();
  design.models.push_back(drawnOn);
  ShortestWay named;
  named.controls = {AtLandmark{"low", {}}, AtLandmark{"high", {}}};
  design.curves.push_back(curve("named", named));
  EXPECT_TRUE(placeCurves(design, model));  // nothing in it is tied to a connectivity
  design.curves.push_back(curve("edges", AlongVertices{{VertexId(0), VertexId(1)}, {}}));
  const Result<std::vector<PlacedCurve>> result = placeCurves(design, model);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::ModelMismatch);
}

}  // namespace
}  // namespace toile
