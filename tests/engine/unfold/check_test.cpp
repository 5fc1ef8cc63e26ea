// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"

namespace toile::unfolding {
namespace {

using std::numbers::pi;

Plane asDrawn(const Mesh& mesh) {
  Plane q(2 * static_cast<Eigen::Index>(mesh.vertexCount()));
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    q.segment<2>(static_cast<Eigen::Index>(2 * v)) = mesh.position(VertexId(v)).head<2>();
  }
  return q;
}

TEST(Check, PassesAPlanePiece) {
  const Mesh mesh = test::irregularGrid(6, 5);
  const Problem problem = *makeProblem(test::patchOf(mesh));
  const Plane q = asDrawn(mesh);
  EXPECT_TRUE(findFlips(problem, q).empty());
  EXPECT_TRUE(findCrossings(problem, q).empty());
  const UnfoldCheck check = makeCheck(problem, q, 0, 0);
  EXPECT_TRUE(check.passes());
  EXPECT_LT(check.maxTurnError, 1e-12);
}

TEST(Check, ReportsAFlippedFaceAndAStretchedEdge) {
  const Mesh mesh = test::grid(4, 4);
  const Problem problem = *makeProblem(test::patchOf(mesh));
  Plane q = asDrawn(mesh);
  q[2 * 12] += 15;  // the middle vertex beyond its neighbour
  EXPECT_FALSE(findFlips(problem, q).empty());
  q = asDrawn(mesh);
  q[2 * 0] -= 0.001;  // a corner of the piece
  const UnfoldCheck check = makeCheck(problem, q, 0, 0);
  EXPECT_NEAR(check.maxLengthError, 0.0001, 1e-6);
  EXPECT_FALSE(check.passes());
  EXPECT_NEAR(check.maxClosureGap, 0.001, 1e-6);
}

TEST(Check, ATriangleWithoutAreaCountsAsFlipped) {
  const Mesh mesh = test::grid(2, 2);
  const Problem problem = *makeProblem(test::patchOf(mesh));
  Plane q = asDrawn(mesh);
  q.segment<2>(0) = Eigen::Vector2d(10, 0);
  q.segment<2>(2) = Eigen::Vector2d(10, 0);
  EXPECT_FALSE(findFlips(problem, q).empty());
}

TEST(Check, FindsWiresThatCrossFarFromEachOtherAlongTheBorder) {
  // A long strip bent in the plane so that its end lies over its beginning.
  const Mesh mesh = test::grid(40, 1);
  const Problem problem = *makeProblem(test::patchOf(mesh));
  Plane q(2 * static_cast<Eigen::Index>(mesh.vertexCount()));
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d& p = mesh.position(VertexId(v));
    const double angle = p.x() / 400 * 2.2 * pi;
    const double radius = 60 - p.y();
    q.segment<2>(static_cast<Eigen::Index>(2 * v)) =
        radius * Eigen::Vector2d(std::sin(angle), -std::cos(angle));
  }
  EXPECT_TRUE(findFlips(problem, q).empty());
  EXPECT_FALSE(findCrossings(problem, q).empty());
}

// The development of a helical strip of more than one turn is a ring that laps over itself.
TEST(Check, UnfoldReportsAHelicalStripOfMoreThanOneTurn) {
  constexpr int kSteps = 120;
  std::vector<Eigen::Vector3d> positions;
  for (int j = 0; j <= 1; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = 2 * pi * 1.5 * i / kSteps;
      const double radius = j == 0 ? 100 : 70;
      positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 6 * angle);
    }
  }
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const VertexId a(i), b(i + 1), c(i + kSteps + 2), d(i + kSteps + 1);
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  const Piece piece = test::patchOf(*makeMesh(positions, triangles));
  const Result<FlatPiece> flat = unfold(piece, {.keepApart = false});
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_GT(flat->check.crossings, 2U);
  EXPECT_EQ(flat->check.flippedFaces, 0U);
  EXPECT_LT(flat->check.maxLengthError, 1e-12);
  EXPECT_FALSE(flat->check.passes());
  ASSERT_FALSE(flat->findings.empty());
  EXPECT_EQ(flat->findings.front().code, "crossings");
  ASSERT_FALSE(flat->overlaps.empty());
  ASSERT_EQ(flat->findings.front().where.size(), 1 + 2 * flat->overlaps.size());
  EXPECT_EQ(flat->findings.front().where.front(), Element::curve("border"));
}

// The sides of a dart without intake lie on each other; that is no crossing.
TEST(Check, ADartInAPlaneDoesNotCrossItself) {
  const Mesh mesh = test::irregularGrid(8, 8);
  PolygonSoup::Chain dart{"wire_dart_waist", {}};
  for (std::uint32_t j = 0; j <= 4; ++j) dart.vertices.push_back(j * 9 + 4);
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh, {dart}));
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_TRUE(flat->findings.empty());
}

}  // namespace
}  // namespace toile::unfolding
