// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/geodesic.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/surface_random.h"
#include "support/test_data.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

std::shared_ptr<const Mesh> share(Mesh mesh) {
  return std::make_shared<const Mesh>(std::move(mesh));
}

SurfacePoint vertex(std::size_t index) {
  return {VertexId(index)};
}

SurfacePoint centre(std::size_t face) {
  return {SurfacePoint::InFace{FaceId(face), Vector3d::Constant(1.0 / 3)}};
}

VertexId nearestVertex(const Mesh& mesh, const Vector3d& to) {
  VertexId best(0);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    if ((mesh.position(VertexId(v)) - to).norm() < (mesh.position(best) - to).norm()) {
      best = VertexId(v);
    }
  }
  return best;
}

double linkLength(const std::shared_ptr<const Mesh>& mesh, const SurfacePoint& a,
                  const SurfacePoint& b) {
  const Result<SurfacePath> path = GeodesicLinker(mesh).link(a, b);
  EXPECT_TRUE(path) << path.error();
  return path ? length(*mesh, *path) : 0;
}

/// Links random pairs and expects of each path what the contract promises.
void expectLocallyShortest(const Mesh& made, int pairs) {
  const auto mesh = share(made);
  GeodesicLinker linker(mesh);
  test::SurfaceRandom random(*mesh, 20261);
  for (int i = 0; i < pairs; ++i) {
    const SurfacePoint a = random.point(), b = random.point();
    if (a == b) continue;
    const Result<SurfacePath> path = linker.link(a, b);
    ASSERT_TRUE(path) << path.error();
    ASSERT_TRUE(isValid(*mesh, *path)) << "pair " << i;
    EXPECT_EQ(path->points.front(), a);
    EXPECT_EQ(path->points.back(), b);
    EXPECT_FALSE(path->closed);
    ASSERT_LE(geodesicDefect(*mesh, *path), 1e-9) << "pair " << i;
    Result<SurfacePath> back = linker.link(b, a);
    ASSERT_TRUE(back);
    std::reverse(back->points.begin(), back->points.end());
    ASSERT_EQ(back->points, path->points) << "pair " << i;
  }
}

TEST(Geodesic, IsTheStraightLineInThePlane) {
  const auto mesh = share(test::irregularGrid(24, 18));
  GeodesicLinker linker(mesh);
  test::SurfaceRandom random(*mesh, 5);
  for (int i = 0; i < 500; ++i) {
    const SurfacePoint a = random.point(), b = random.point();
    if (a == b) continue;
    const Result<SurfacePath> path = linker.link(a, b);
    ASSERT_TRUE(path) << path.error();
    const Vector3d from = position(*mesh, a), to = position(*mesh, b);
    EXPECT_NEAR(length(*mesh, *path), (to - from).norm(), 1e-10);
    for (const SurfacePoint& point : path->points) {
      const Vector3d p = position(*mesh, point);
      EXPECT_LT((p - from).cross(to - from).norm() / (to - from).norm(), 1e-10);
    }
  }
}

// Through vertices and along edges: on a regular grid many links meet them exactly.
TEST(Geodesic, PassesThroughVerticesThatLieOnTheLine) {
  const auto mesh = share(test::grid(8, 8, 10));
  const Result<SurfacePath> diagonal = GeodesicLinker(mesh).link(vertex(0), vertex(80));
  ASSERT_TRUE(diagonal);
  EXPECT_EQ(diagonal->points.size(), 9U);
  const Result<SurfacePath> row = GeodesicLinker(mesh).link(vertex(36), vertex(44));
  ASSERT_TRUE(row);
  EXPECT_EQ(row->points.size(), 9U);
  for (const SurfacePoint& p : row->points) EXPECT_TRUE(std::holds_alternative<VertexId>(p.at));
}

TEST(Geodesic, IsTheHelixOfAPrism) {
  const int segments = 32;
  const double radius = 60, height = 240, chord = 2 * radius * std::sin(pi / segments);
  const auto mesh = share(test::cylinder(radius, height, segments, 20));
  for (const int around : {1, 5, 11, 15}) {
    for (const int up : {1, 7, 20}) {
      const double expected = std::hypot(around * chord, up * height / 20);
      EXPECT_NEAR(
          linkLength(mesh, vertex(3), vertex(static_cast<std::size_t>(3 + around + up * segments))),
          expected, 1e-9);
    }
  }
}

TEST(Geodesic, KnowsTheCube) {
  for (const int n : {1, 2, 5}) {
    const auto mesh = share(test::cube(100, n));
    const SurfacePoint origin{nearestVertex(*mesh, {0, 0, 0})};
    EXPECT_NEAR(linkLength(mesh, origin, {nearestVertex(*mesh, {100, 100, 100})}),
                100 * std::sqrt(5.0), 1e-9);
    EXPECT_NEAR(linkLength(mesh, origin, {nearestVertex(*mesh, {100, 100, 0})}),
                100 * std::sqrt(2.0), 1e-9);
  }
}

TEST(Geodesic, IsCloseToTheGreatCircle) {
  const auto mesh = share(test::icosphere(100, 4));
  test::SurfaceRandom random(*mesh, 11);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint a = random.point(), b = random.point();
    const Vector3d p = position(*mesh, a).normalized(), q = position(*mesh, b).normalized();
    const double arc = 100 * std::atan2(p.cross(q).norm(), p.dot(q));
    if (arc < 20) continue;
    EXPECT_NEAR(linkLength(mesh, a, b) / arc, 1, 0.004);
  }
}

// A spike: the straight way over it is longer than the way around, and its tip is never passed.
TEST(Geodesic, GoesAroundASpikeAndThroughASaddle) {
  const auto spike = share(test::heightField(
      10, 10, 10, [](double x, double y) { return x == 50 && y == 50 ? 60.0 : 0.0; }));
  const Result<SurfacePath> around =
      GeodesicLinker(spike).link(vertex(5 * 11 + 2), vertex(5 * 11 + 8));
  ASSERT_TRUE(around);
  for (const SurfacePoint& p : around->points) EXPECT_LT(position(*spike, p).z(), 1e-9);
  EXPECT_LE(geodesicDefect(*spike, *around), 1e-9);
  EXPECT_GT(length(*spike, *around), 60);

  // The crotch of the trousers is a saddle: the way between the legs bends there.
  const auto trousers = share(test::trousers());
  const Result<SurfacePath> between = GeodesicLinker(trousers).link(
      {nearestVertex(*trousers, {40, 0, 300})}, {nearestVertex(*trousers, {-40, 0, 300})});
  ASSERT_TRUE(between);
  EXPECT_LE(geodesicDefect(*trousers, *between), 1e-9);
}

// Past a reflex corner of the border the shortest way runs along the border.
TEST(Geodesic, MayRunAlongTheBorder) {
  const Mesh whole = test::grid(20, 10, 10);
  std::vector<Triangle> kept;
  for (const Triangle& triangle : whole.triangles()) {
    Vector3d middle = Vector3d::Zero();
    for (const VertexId v : triangle) middle += whole.position(v) / 3;
    if (middle.x() < 60 || middle.x() > 140 || middle.y() < 50) kept.push_back(triangle);
  }
  std::vector<VertexId> renumbered(whole.vertexCount());
  std::vector<Vector3d> positions;
  for (Triangle& triangle : kept) {
    for (VertexId& v : triangle) {
      VertexId& name = renumbered[v.index()];
      if (!name.isValid()) {
        name = VertexId(positions.size());
        positions.push_back(whole.position(v));
      }
      v = name;
    }
  }
  const Result<Mesh> made = makeMesh(positions, kept);
  ASSERT_TRUE(made) << made.error();
  const auto mesh = share(*made);
  const SurfacePoint a{nearestVertex(*mesh, {20, 100, 0})};
  const SurfacePoint b{nearestVertex(*mesh, {180, 100, 0})};
  const Result<SurfacePath> path = GeodesicLinker(mesh).link(a, b);
  ASSERT_TRUE(path) << path.error();
  EXPECT_NEAR(length(*mesh, *path), 80 + 2 * std::hypot(40, 50), 1e-9);
  EXPECT_LE(geodesicDefect(*mesh, *path), 1e-9);
}

TEST(Geodesic, IsLocallyShortestForAnyPair) {
  expectLocallyShortest(test::grid(20, 20), 1000);
  expectLocallyShortest(test::irregularGrid(25, 25), 1000);
  expectLocallyShortest(test::cylinder(50, 300, 24, 30), 1000);
  expectLocallyShortest(test::closedCylinder(50, 300, 24, 30), 1000);
  expectLocallyShortest(test::cube(100, 6), 1000);
  expectLocallyShortest(test::icosphere(100, 3), 1000);
  expectLocallyShortest(test::torus(100, 30, 50, 24), 1000);
  expectLocallyShortest(test::saddle(24, 10, 0.02), 1000);
  expectLocallyShortest(test::trousers(), 1000);
  expectLocallyShortest(test::coneStrip(10, 150, 24, 20, 0.5), 1000);
}

TEST(Geodesic, IsLocallyShortestOnABody) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/female_average.ply");
  const Result<MeshFile> body = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(body) << body.error();
  expectLocallyShortest(body->mesh, 1000);
}

// Tetrahedra and double triangles: faces that share two edges, vertices with two or three faces.
TEST(Geodesic, SurvivesTheSmallestMeshes) {
  const std::vector<Vector3d> corners{{0, 0, 0}, {10, 0, 0}, {3, 9, 0}, {4, 3, 8}};
  const auto id = [](std::size_t i) { return VertexId(i); };
  const Result<Mesh> tetrahedron = makeMesh(
      corners,
      {{id(0), id(2), id(1)}, {id(0), id(1), id(3)}, {id(1), id(2), id(3)}, {id(2), id(0), id(3)}});
  ASSERT_TRUE(tetrahedron) << tetrahedron.error();
  expectLocallyShortest(*tetrahedron, 2000);
  const Result<Mesh> pillow = makeMesh({corners[0], corners[1], corners[2]},
                                       {{id(0), id(1), id(2)}, {id(0), id(2), id(1)}});
  if (pillow) expectLocallyShortest(*pillow, 2000);
  const Result<Mesh> triangle =
      makeMesh({corners[0], corners[1], corners[2]}, {{id(0), id(1), id(2)}});
  ASSERT_TRUE(triangle);
  expectLocallyShortest(*triangle, 100);
}

// Ends a hair from vertices and edges, where directions are ill-defined in absolute numbers.
TEST(Geodesic, AcceptsEndsCloseToVerticesAndEdges) {
  const auto mesh = share(test::irregularGrid(12, 12));
  GeodesicLinker linker(mesh);
  test::SurfaceRandom random(*mesh, 3);
  for (const double hair : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    for (int i = 0; i < 200; ++i) {
      const SurfacePoint a = random.pointNearCorner(hair), b = random.pointNearCorner(hair);
      if (a == b) continue;
      const Result<SurfacePath> path = linker.link(a, b);
      ASSERT_TRUE(path) << path.error();
      ASSERT_TRUE(isValid(*mesh, *path));
      EXPECT_NEAR(length(*mesh, *path), (position(*mesh, a) - position(*mesh, b)).norm(), 1e-9);
    }
  }
}

// A way at the very edge of going through a vertex, whose spokes are of very different lengths,
// goes through it for all of them or for none: never from the vertex back to a spoke.
TEST(Geodesic, PassesAVertexForAllSpokesOrNone) {
  const std::vector<Vector3d> star{{0, 0, 0},   {-12, -6, 0},    {0, -1, 0},
                                   {12, -6, 0}, {12, 6, 0},      {3, 5, 0},
                                   {0, 1, 0},   {-0.2, 0.15, 0}, {-12, 6, 0}};
  std::vector<Triangle> spokes;
  for (std::size_t i = 1; i <= 8; ++i) {
    spokes.push_back({VertexId(0), VertexId(i), VertexId(i % 8 + 1)});
  }
  const Result<Mesh> made = makeMesh(star, spokes);
  ASSERT_TRUE(made) << made.error();
  const auto mesh = share(*made);
  GeodesicLinker linker(mesh);
  for (int step = 0; step < 400; ++step) {
    const double above = std::pow(10.0, -14 + 0.015 * step) * (step % 2 == 0 ? 1 : -1);
    const double up = 5.0 / 12 + above / 12, down = 5.0 / 12 - above / 12;
    const SurfacePoint left = makeSurfacePoint(*mesh, FaceId(7), {1.0 / 6, up, down}),
                       right = makeSurfacePoint(*mesh, FaceId(2), {1.0 / 6, down, up});
    const Result<SurfacePath> path = linker.link(left, right);
    ASSERT_TRUE(path) << path.error();
    ASSERT_TRUE(isValid(*mesh, *path));
    EXPECT_LE(geodesicDefect(*mesh, *path), 1e-9) << above << " mm above the vertex";
  }
}

// Ends in the two faces of an edge, both on it but for rounding: the way runs along the edge and
// passes over it between them, not at the edge's end.
TEST(Geodesic, RunsAlongAnEdgeFromOneSideToTheOther) {
  const auto mesh = share(test::icosphere(100, 2));
  GeodesicLinker linker(mesh);
  for (std::size_t e = 0; e < 100; ++e) {
    const HalfedgeId h = mesh->halfedge(EdgeId(e)), other = mesh->opposite(h);
    const auto beside = [&](HalfedgeId side, double along, double hair) {
      Vector3d weights = Vector3d::Constant(hair);
      const int from = mesh->side(side);
      weights[from] = side == h ? 1 - along : along;
      weights[(from + 1) % 3] = side == h ? along : 1 - along;
      // Not by makeSurfacePoint(), which would put it on the edge.
      return SurfacePoint{SurfacePoint::InFace{mesh->face(side), weights}};
    };
    for (const double hair : {1e-14, 1e-20, 1e-27}) {
      for (const double gap : {-0.3, -1e-4, -1e-7, 1e-7, 1e-4, 0.3}) {
        const SurfacePoint a = beside(h, 0.4, hair), b = beside(other, 0.4 + gap, 0.7 * hair);
        const Result<SurfacePath> path = linker.link(a, b);
        ASSERT_TRUE(path) << path.error();
        ASSERT_TRUE(isValid(*mesh, *path));
        EXPECT_NEAR(length(*mesh, *path), (position(*mesh, a) - position(*mesh, b)).norm(), 1e-9)
            << hair << " beside edge " << e << ", " << gap << " of it apart";
      }
    }
  }
}

TEST(Geodesic, MovesWithTheMesh) {
  // Without symmetry: where two ways are equally long, rounding may choose.
  const Eigen::Matrix3d skew{{1, 0.13, 0.31}, {0.07, 1.1, 0.05}, {0.02, 0.17, 0.9}};
  const Mesh made = test::transformed(test::torus(100, 30, 40, 20), skew, {0, 0, 0});
  Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto mesh = share(made);
  const auto moved = share(test::transformed(made, 2.5 * turn, {100, -40, 900}));
  test::SurfaceRandom random(*mesh, 8);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint a = random.point(), b = random.point();
    if (a == b) continue;
    const double here = linkLength(mesh, a, b), there = linkLength(moved, a, b);
    EXPECT_NEAR(there, 2.5 * here, 1e-8 * here) << "pair " << i;
  }
}

TEST(Geodesic, RefusesWhatHasNoLink) {
  const Mesh one = test::icosphere(10, 1);
  std::vector<Vector3d> positions = one.positions();
  std::vector<Triangle> triangles = one.triangles();
  const std::size_t count = positions.size();
  for (std::size_t v = 0; v < count; ++v) positions.push_back(positions[v] + Vector3d(50, 0, 0));
  for (const auto& [a, b, c] : one.triangles()) {
    triangles.push_back(
        {VertexId(a.index() + count), VertexId(b.index() + count), VertexId(c.index() + count)});
  }
  const Result<Mesh> two = makeMesh(positions, triangles);
  ASSERT_TRUE(two);
  GeodesicLinker linker(share(*two));
  const Result<SurfacePath> apart = linker.link(vertex(0), vertex(count));
  ASSERT_FALSE(apart);
  EXPECT_EQ(apart.error().code, ErrorCode::CurveInvalid);
  const Result<SurfacePath> same = linker.link(centre(3), centre(3));
  ASSERT_FALSE(same);
  EXPECT_EQ(same.error().code, ErrorCode::CurveInvalid);
  const Result<SurfacePath> outside = linker.link(vertex(0), vertex(99999));
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().code, ErrorCode::CurveInvalid);
}

TEST(Geodesic, LinksARowOfPointsAndClosesIt) {
  const auto mesh = share(test::icosphere(100, 3));
  GeodesicLinker linker(mesh);
  const std::vector<SurfacePoint> row{centre(3), centre(3), vertex(20), centre(400), vertex(100)};
  const Result<SurfacePath> open = linker.linkAll(row, false);
  ASSERT_TRUE(open) << open.error();
  EXPECT_TRUE(isValid(*mesh, *open));
  for (const SurfacePoint& p : row) {
    EXPECT_EQ(std::count(open->points.begin(), open->points.end(), p), 1);
  }
  const Result<SurfacePath> closed = linker.linkAll(row, true);
  ASSERT_TRUE(closed) << closed.error();
  EXPECT_TRUE(closed->closed);
  EXPECT_TRUE(isValid(*mesh, *closed));
  EXPECT_NEAR(length(*mesh, *closed),
              length(*mesh, *open) + linkLength(mesh, row.back(), row.front()), 1e-9);
  EXPECT_FALSE(linker.linkAll(std::vector{centre(3), centre(3)}, false));
  EXPECT_FALSE(linker.linkAll(std::vector{centre(3), centre(5), centre(3)}, true));
}

// The measure itself must be able to be bad.
TEST(GeodesicDefect, SeesAKinkInAFaceOnAnEdgeAndAtAVertex) {
  const Mesh mesh = test::grid(2, 2, 10);
  const auto pathThrough = [&](const SurfacePoint& middle, const SurfacePoint& a,
                               const SurfacePoint& b) {
    return SurfacePath{
        {a, middle, b}, {commonFace(mesh, a, middle), commonFace(mesh, middle, b)}, false};
  };
  // The right angle in the grid's corner cell: border on one side, short of pi on the other.
  EXPECT_NEAR(geodesicDefect(mesh, pathThrough(vertex(4), vertex(3), vertex(1))), pi / 2, 1e-12);
  EXPECT_NEAR(geodesicDefect(mesh, pathThrough(vertex(4), vertex(3), vertex(5))), 0, 1e-12);
  const FaceId face(0);  // (0,0), (10,0), (10,10)
  const SurfacePoint inner = makeSurfacePoint(mesh, face, {0.25, 0.5, 0.25});
  // inner lies at (7.5, 2.5): its directions to (0, 0) and (10, 10) make an angle of about 126.9.
  EXPECT_NEAR(
      geodesicDefect(mesh, pathThrough(inner, vertex(0), vertex(4))),
      pi - std::acos(Vector3d(-7.5, -2.5, 0).normalized().dot(Vector3d(2.5, 7.5, 0).normalized())),
      1e-12);
  const SurfacePoint onEdge = makeSurfacePoint(mesh, face, {0.5, 0, 0.5});
  EXPECT_NEAR(geodesicDefect(mesh, pathThrough(onEdge, vertex(1), vertex(3))), 0, 1e-12);
  EXPECT_NEAR(geodesicDefect(mesh, pathThrough(onEdge, vertex(1), vertex(0))), 3 * pi / 4 - pi / 4,
              1e-12);
}

}  // namespace
}  // namespace toile
