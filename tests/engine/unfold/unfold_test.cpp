// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/unfold/unfold.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

/// Equal up to a motion of the plane; a mirror image is not.
void expectCongruent(const std::vector<Vector2d>& flat, const std::vector<Vector2d>& expected,
                     double tolerance) {
  ASSERT_EQ(flat.size(), expected.size());
  Vector2d from = Vector2d::Zero(), to = Vector2d::Zero();
  for (std::size_t i = 0; i < flat.size(); ++i) {
    from += flat[i] / static_cast<double>(flat.size());
    to += expected[i] / static_cast<double>(flat.size());
  }
  double dot = 0, cross = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Vector2d a = flat[i] - from, b = expected[i] - to;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
  }
  const Eigen::Rotation2D<double> turn(std::atan2(cross, dot));
  for (std::size_t i = 0; i < flat.size(); ++i) {
    EXPECT_LT((turn * (flat[i] - from) - (expected[i] - to)).norm(), tolerance) << "vertex " << i;
  }
}

// A mesh whose inner vertices have no curvature can lie flat without any strain, and the solution
// is unique: the development.
TEST(Unfold, LeavesAPlanePieceAsItIs) {
  const Mesh mesh = test::irregularGrid(9, 7);
  const Piece piece = test::patchOf(test::turnedAnyhow(mesh));
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  std::vector<Vector2d> expected;
  for (const auto& p : mesh.positions()) expected.push_back(p.head<2>());
  expectCongruent(flat->position.values(), expected, 1e-8);
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LT(flat->maxAreaError, 1e-9);
  EXPECT_TRUE(flat->findings.empty());
}

TEST(Unfold, DevelopsAHalfCylinder) {
  constexpr int kSegments = 24, kRows = 10;
  const Piece piece = test::patchOf(test::halfCylinder(80, 300, kSegments, kRows));
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const double chord = 2 * 80 * std::sin(pi / (2 * kSegments));
  std::vector<Vector2d> expected;
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kSegments; ++i) expected.emplace_back(chord * i, 30.0 * j);
  }
  expectCongruent(flat->position.values(), expected, 1e-7);
  EXPECT_LT(flat->check.maxLengthError, 1e-12);
}

TEST(Unfold, DevelopsAConeStrip) {
  constexpr int kSegments = 24, kRows = 10;
  constexpr double kHalfApex = 0.5;
  const Piece piece = test::patchOf(test::coneStrip(100, 250, kSegments, kRows, kHalfApex));
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const double facet = 2 * std::asin(std::sin(kHalfApex) * std::sin(pi / (2 * kSegments)));
  std::vector<Vector2d> expected;
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kSegments; ++i) {
      const double slant = 250 - 15.0 * j;
      expected.emplace_back(slant * std::cos(facet * i), slant * std::sin(facet * i));
    }
  }
  expectCongruent(flat->position.values(), expected, 1e-7);
}

TEST(Unfold, StandsUprightRightSideUpAroundTheOrigin) {
  const Mesh mesh = test::halfCylinder(80, 300, 24, 10);
  const Piece piece = test::patchOf(mesh);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  Vector2d centroid = Vector2d::Zero();
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles()) {
    const Vector2d u = flat->position[b] - flat->position[a];
    const Vector2d w = flat->position[c] - flat->position[a];
    const double twice = u.x() * w.y() - u.y() * w.x();
    EXPECT_GT(twice, 0);
    area += twice;
    centroid += twice * (flat->position[a] + flat->position[b] + flat->position[c]) / 3;
  }
  EXPECT_LT((centroid / area).norm(), 1e-9);
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    const VertexId v{i};
    EXPECT_NEAR(flat->position[v].y(), mesh.position(v).z() - 150, 1e-7);
  }
}

TEST(Unfold, KeepsEveryWireLengthOfACurvedPieceWithFeatures) {
  // A dome of 24 x 24 cells with a line across, one that ends in the cloth, one that floats and a
  // closed one.
  const Mesh mesh = test::heightField(24, 24, 10, [](double x, double y) {
    return 60 * std::exp(-((x - 120) * (x - 120) + (y - 120) * (y - 120)) / 9000);
  });
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * 25 + i); };
  std::vector<PolygonSoup::Chain> chains(4);
  chains[0].group = "wire_feature_across";
  for (int i = 0; i <= 24; ++i) chains[0].vertices.push_back(at(i, 5));
  chains[1].group = "wire_feature_dangling";
  for (int j = 0; j <= 4; ++j) chains[1].vertices.push_back(at(12, j));
  chains[2].group = "wire_feature_floating";
  for (int i = 4; i <= 10; ++i) chains[2].vertices.push_back(at(i, 20));
  chains[3].group = "wire_feature_closed";
  for (int i = 14; i < 20; ++i) chains[3].vertices.push_back(at(i, 12));
  for (int j = 12; j < 18; ++j) chains[3].vertices.push_back(at(20, j));
  for (int i = 20; i > 14; --i) chains[3].vertices.push_back(at(i, 18));
  for (int j = 18; j >= 12; --j) chains[3].vertices.push_back(at(14, j));
  const Piece piece = test::patchOf(mesh, chains);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  std::size_t checked = 0;
  for (const Wire& wire : piece.wires) {
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const double length =
          (flat->position[wire.vertices[i]] - flat->position[wire.vertices[i + 1]]).norm();
      EXPECT_NEAR(length, wire.targetLength[i], 1e-11) << wire.curve << " edge " << i;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 4U * 24 + 24 + 4 + 6 + 24);
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LE(flat->check.maxLengthError, 1e-12);
}

/// A dome with a slope, so that its up is not in doubt.
Mesh dome() {
  return test::heightField(14, 12, 10, [](double x, double y) {
    return 0.7 * y + 30 * std::exp(-((x - 60) * (x - 60) + (y - 70) * (y - 70)) / 3000);
  });
}

TEST(Unfold, DoesNotDependOnTheNumbering) {
  const Mesh mesh = dome();
  const std::size_t n = mesh.vertexCount();
  std::vector<Eigen::Vector3d> positions(n);
  const auto renumbered = [&](VertexId v) { return VertexId((v.index() * 7 + 11) % n); };
  ASSERT_NE(n % 7, 0U);
  for (std::size_t v = 0; v < n; ++v) {
    positions[renumbered(VertexId(v)).index()] = mesh.position(VertexId(v));
  }
  std::vector<Triangle> triangles;
  for (std::size_t f = mesh.faceCount(); f-- > 0;) {
    const Triangle& t = mesh.triangles()[f];
    triangles.push_back({renumbered(t[1]), renumbered(t[2]), renumbered(t[0])});
  }
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh));
  const Result<FlatPiece> other = unfold(test::patchOf(*makeMesh(positions, triangles)));
  ASSERT_TRUE(flat && other);
  EXPECT_GT(flat->meanAreaError, 0.005);
  // Both stop where the energy falls by less than 1e-4 of itself, on slightly other ways.
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_LT((flat->position[VertexId(v)] - other->position[renumbered(VertexId(v))]).norm(),
              0.02);
  }
}

TEST(Unfold, MovesAndScalesWithThePiece) {
  const Mesh mesh = dome();
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh));
  const Eigen::AngleAxisd turn(2.5, Eigen::Vector3d::UnitZ());
  const Result<FlatPiece> moved = unfold(test::patchOf(
      test::transformed(mesh, 3 * turn.toRotationMatrix(), Eigen::Vector3d(500, -200, 900))));
  ASSERT_TRUE(flat && moved);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    EXPECT_LT((3 * flat->position[VertexId(v)] - moved->position[VertexId(v)]).norm(), 1e-6);
  }
  EXPECT_NEAR(flat->meanAreaError, moved->meanAreaError, 1e-9);
}

/// A cap of a sphere around the z axis, from the pole to a level circle.
Mesh smoothCap(double radius, double halfAngle, int segments, int rows) {
  std::vector<Eigen::Vector3d> positions{{0, 0, radius}};
  for (int j = 1; j <= rows; ++j) {
    for (int i = 0; i < segments; ++i) {
      const double polar = halfAngle * j / rows, around = 2 * pi * i / segments;
      positions.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                                   std::sin(polar) * std::sin(around),
                                                   std::cos(polar)));
    }
  }
  const auto at = [&](int i, int j) {
    return VertexId(static_cast<std::size_t>(1 + (j - 1) * segments + i % segments));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < segments; ++i) {
    triangles.push_back({VertexId(0), at(i, 1), at(i + 1, 1)});
    for (int j = 1; j < rows; ++j) {
      triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return *makeMesh(positions, triangles);
}

// No outline of the rim's length holds more than a circle of that length does: the area that is
// missing is known beforehand.
TEST(Unfold, ReachesTheAreaThatTheRimOfACapForces) {
  const Mesh mesh = smoothCap(100, pi / 3, 48, 12);
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh));
  ASSERT_TRUE(flat) << flat.error();
  double rim = 0, surface = 0;
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    if (mesh.isBorder(EdgeId(e))) rim += mesh.length(EdgeId(e));
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) surface += mesh.area(FaceId(f));
  const double forced = 1 - rim * rim / (4 * pi) / surface;
  EXPECT_GT(flat->meanAreaError, forced);
  EXPECT_LT(flat->meanAreaError, forced + 0.01);
  EXPECT_TRUE(flat->check.passes());
}

TEST(Unfold, AreaWeightTradesAnglesForArea) {
  const Piece piece = test::patchOf(test::saddle(16));
  double last = 1;
  for (const double weight : {0.0, 2.0, 10.0}) {
    const Result<FlatPiece> flat = unfold(piece, {.areaWeight = weight});
    ASSERT_TRUE(flat) << flat.error();
    EXPECT_LT(flat->meanAreaError, 0.9 * last) << weight;
    last = flat->meanAreaError;
  }
}

TEST(Unfold, TargetsCountNotTheLengthsOnTheSurface) {
  const Mesh mesh = test::irregularGrid(10, 8);
  Piece piece = test::patchOf(mesh);
  for (double& target : piece.wires[0].targetLength) target *= 0.95;
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_LE(flat->check.maxLengthError, 1e-12);
  EXPECT_GT(flat->meanAreaError, 0.02);  // the outline gets rounder to hold more
  const Wire& wire = piece.wires[0];
  for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
    EXPECT_NEAR((flat->position[wire.vertices[i]] - flat->position[wire.vertices[i + 1]]).norm(),
                0.95 * wire.bodyLength[i], 1e-10);
  }
}

TEST(Unfold, BearsNeedleTriangles) {
  Mesh mesh = dome();
  std::vector<Eigen::Vector3d> positions = mesh.positions();
  for (auto& p : positions) p.x() /= 200;
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh.withPositions(positions)));
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LE(flat->check.maxLengthError, 1e-11);
}

TEST(Unfold, RunsTwiceToTheSameBits) {
  const Piece piece = test::patchOf(dome());
  const Result<FlatPiece> first = unfold(piece), second = unfold(piece);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->position, second->position);
}

// A flat end of a tube cannot close in the plane; the hole of a ring can.
TEST(Unfold, RefusesATubeAndNamesItsEnds) {
  const Piece piece = test::patchOf(test::cylinder(50, 100, 20, 5));
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::NotADisk);
  ASSERT_EQ(flat.error().where.size(), 2U);
  EXPECT_LT(flat.error().where[0].index, 20U);
  EXPECT_GE(flat.error().where[1].index, 100U);
}

TEST(Unfold, RefusesAClosedSurfaceAndOneWithAHandle) {
  const Result<FlatPiece> closed = unfold(test::patchOf(test::icosphere(50, 1)));
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().code, ErrorCode::NotADisk);
  EXPECT_TRUE(closed.error().where.empty());
  const Result<FlatPiece> handle =
      unfold(test::patchOf(test::withoutFace(test::torus(80, 30, 16, 8))));
  ASSERT_FALSE(handle);
  EXPECT_EQ(handle.error().code, ErrorCode::NotADisk);
}

TEST(Unfold, KeepsAHoleOpen) {
  const Mesh mesh =
      test::ring(60, 140, 32, 6, [](double x, double y) { return 0.002 * (x * x + 0.5 * y * y); });
  const Piece piece = test::patchOf(mesh);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LT(flat->meanAreaError, 0.1);
}

TEST(Unfold, NamesFacesWithoutArea) {
  Mesh mesh = test::grid(4, 4);
  std::vector<Eigen::Vector3d> positions = mesh.positions();
  positions[12] = positions[13];
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh.withPositions(positions)));
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::DegenerateFace);
  EXPECT_EQ(flat.error().where.size(), 2U);
}

// All edges of a dome are wires: they hold its curvature, and nothing can lie flat.
TEST(Unfold, NamesWiresThatContradictEachOther) {
  const Mesh mesh = test::heightField(8, 8, 10, [](double x, double y) {
    return 30 - 0.01 * ((x - 40) * (x - 40) + (y - 40) * (y - 40));
  });
  std::vector<PolygonSoup::Chain> chains;
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const EdgeId edge{e};
    chains.push_back(
        {"wire_feature_" + std::to_string(e), {mesh.tail(edge).index(), mesh.head(edge).index()}});
  }
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh, chains));
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::LengthsInfeasible) << flat.error();
  ASSERT_FALSE(flat.error().where.empty());
  EXPECT_EQ(flat.error().where.front().kind, Element::Kind::Curve);
}

class CancelAfter : public Progress {
 public:
  explicit CancelAfter(int polls) : left_(polls) {}
  void step(std::string_view) override {}
  [[nodiscard]] bool isCancelled() const override { return left_-- <= 0; }

 private:
  mutable int left_;
};

TEST(Unfold, StopsWhenCancelled) {
  const Piece piece = test::patchOf(test::saddle(16));
  CancelAfter soon(1);
  const Result<FlatPiece> flat = unfold(piece, {}, &soon);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::Cancelled);
}

TEST(Unfold, RefusesOptionsOutOfRange) {
  const Piece piece = test::patchOf(test::grid(2, 2));
  for (const UnfoldOptions& options :
       {UnfoldOptions{.areaWeight = -1}, UnfoldOptions{.areaWeight = std::nan("")},
        UnfoldOptions{.wireStiffness = 11}, UnfoldOptions{.maxSteps = 0}}) {
    const Result<FlatPiece> flat = unfold(piece, options);
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().code, ErrorCode::InvalidArgument);
  }
}

}  // namespace
}  // namespace toile
