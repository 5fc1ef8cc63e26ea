// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/develop/develop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "develop/angle_sums.h"
#include "develop/shape.h"
#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "support/test_data.h"

namespace toile {
namespace {

/// The outer side of a ring with round tube, 120 degrees of the ring and 120 of the tube, with a
/// line along the middle: the article's patch.
Mesh torusPatch(int columns = 24, int rows = 20) {
  const Mesh plane = test::grid(columns, rows, 1);
  std::vector<Eigen::Vector3d> at;
  for (const Eigen::Vector3d& p : plane.positions()) {
    const double u = (p.x() / columns - 0.5) * 2 * std::numbers::pi / 3;
    const double v = (p.y() / rows - 0.5) * 120 * std::numbers::pi / 180;
    const double ring = 100 + 50 * std::cos(v);
    at.emplace_back(ring * std::cos(u), ring * std::sin(u), 50 * std::sin(v));
  }
  return plane.withPositions(std::move(at));
}

std::vector<PolygonSoup::Chain> middleLine(int columns = 24, int rows = 20) {
  PolygonSoup::Chain chain{"wire_feature_mid", {}, 0};
  for (int i = 0; i <= columns; ++i) {
    chain.vertices.push_back(static_cast<std::uint32_t>(rows / 2 * (columns + 1) + i));
  }
  return {chain};
}

void expectBorderUnmoved(const Piece& before, const Piece& after) {
  for (std::size_t i = 0; i < before.mesh->vertexCount(); ++i) {
    const VertexId v{i};
    if (before.mesh->isBorder(v)) {
      EXPECT_EQ(before.mesh->position(v), after.mesh->position(v)) << "vertex " << i;
    }
  }
  for (std::size_t w = 0; w < before.wires.size(); ++w) {
    if (isBoundary(before.wires[w].kind)) {
      EXPECT_EQ(before.wires[w].targetLength, after.wires[w].targetLength);
    }
  }
}

TEST(Develop, GradientOfAngleSumsAgreesWithDifferences) {
  const Mesh mesh = test::saddle(6, 10, 0.02);
  const developing::FreeVertices inner(mesh);
  const developing::Positions normals = developing::vertexNormals(mesh, mesh.positions());
  const Eigen::MatrixXd gradient =
      developing::angleSumGradient(mesh, inner, mesh.positions(), normals);
  const double step = 1e-4;
  for (Eigen::Index j = 0; j < inner.count(); ++j) {
    const std::size_t v = inner.vertices[static_cast<std::size_t>(j)].index();
    developing::Positions forth = mesh.positions(), back = mesh.positions();
    forth[v] += step * normals[v];
    back[v] -= step * normals[v];
    const Eigen::VectorXd difference =
        -(developing::defects(mesh, inner, forth) - developing::defects(mesh, inner, back)) /
        (2 * step);
    EXPECT_LT((difference - gradient.col(j)).cwiseAbs().maxCoeff(), 1e-8) << "column " << j;
  }
}

TEST(Develop, ADevelopablePieceStaysAsItIs) {
  const Piece piece = test::patchOf(test::halfCylinder(80, 300, 16, 20));
  const Result<DevelopedPiece> developed = develop(piece);
  ASSERT_TRUE(developed) << developed.error();
  EXPECT_EQ(developed->piece.mesh->positions(), piece.mesh->positions());
  EXPECT_TRUE(developed->findings.empty());
  EXPECT_EQ(developed->report.maxMove, 0);
}

TEST(Develop, NothingMovesAtZero) {
  const Piece piece = test::patchOf(torusPatch(), middleLine());
  const Result<DevelopedPiece> developed = develop(piece, {.amount = 0});
  ASSERT_TRUE(developed) << developed.error();
  EXPECT_EQ(contentHash(developed->piece), contentHash(piece));
  EXPECT_NEAR(developed->report.errorBefore, developed->report.errorAgainstOriginal, 1e-12);
}

// The article's figure 5: strain against the processed surface falls, against the one before it
// rises, and the line inside becomes shorter. All three must be told.
TEST(Develop, ATorusPatchLiesFlatAndTellsThePrice) {
  const Piece piece = test::patchOf(torusPatch(), middleLine());
  const Result<DevelopedPiece> developed = develop(piece, {.amount = 0.7});
  ASSERT_TRUE(developed) << developed.error();
  const DevelopReport& report = developed->report;
  expectBorderUnmoved(piece, developed->piece);
  EXPECT_TRUE(developed->flat->check.passes());
  EXPECT_GT(report.errorBefore, 0.05);
  EXPECT_LT(report.errorAgainstProcessed, 0.25 * report.errorBefore);
  EXPECT_GT(report.errorAgainstOriginal, report.errorBefore);
  EXPECT_LT(report.totalDefect, report.totalDefectBefore);
  EXPECT_LT(report.roughness, 1.2 * report.roughnessBefore);

  ASSERT_EQ(report.features.size(), 1U);
  double before = 0, after = 0;
  for (const Wire& wire : developed->piece.wires) {
    if (wire.kind != WireKind::Feature) continue;
    for (std::size_t i = 0; i < wire.targetLength.size(); ++i) {
      const auto length = [&](const Mesh& mesh) {
        return (mesh.position(wire.vertices[i]) - mesh.position(wire.vertices[i + 1])).norm();
      };
      before += length(*piece.mesh);
      after += length(*developed->piece.mesh);
      EXPECT_NEAR(wire.targetLength[i], length(*developed->piece.mesh), 1e-12);
      EXPECT_EQ(wire.bodyLength[i], length(*piece.mesh));
    }
  }
  EXPECT_NEAR(report.features[0].before, before, 1e-9);
  EXPECT_NEAR(report.features[0].after, after, 1e-9);
  EXPECT_LT(after, before);
  EXPECT_NEAR(report.maxFeatureChange, 1 - after / before, 1e-12);
}

// A saddle has no smooth developable surface through its border nearby; angle sums of 2 pi alone
// would crumple it.
TEST(Develop, ASaddleDoesNotCrumple) {
  const Piece piece = test::patchOf(test::saddle(20, 10, 0.01));
  const Result<DevelopedPiece> developed = develop(piece);
  ASSERT_TRUE(developed) << developed.error();
  const DevelopReport& report = developed->report;
  expectBorderUnmoved(piece, developed->piece);
  EXPECT_LT(report.errorAgainstProcessed, report.errorBefore);
  EXPECT_LE(report.roughness, 1.5 * report.roughnessBefore);
  EXPECT_LE(report.maxNormalTurn, std::numbers::pi / 3);
  ASSERT_EQ(developed->findings.size(), 1U);
  EXPECT_EQ(developed->findings[0].code, "develop-stopped");
}

TEST(Develop, TakesTheSmallestAmountForALimit) {
  const Piece piece = test::patchOf(torusPatch(), middleLine());
  const Result<DevelopedPiece> developed = develop(piece, {.maxAreaError = Ratio::percent(3)});
  ASSERT_TRUE(developed) << developed.error();
  EXPECT_LE(developed->report.errorAgainstProcessed, 0.03);
  EXPECT_GT(developed->amount, 0);
  const Result<DevelopedPiece> less = develop(piece, {.amount = developed->amount - 0.01});
  ASSERT_TRUE(less) << less.error();
  EXPECT_GT(less->report.errorAgainstProcessed, 0.03);

  const Result<DevelopedPiece> enough = develop(piece, {.maxAreaError = Ratio::percent(20)});
  ASSERT_TRUE(enough) << enough.error();
  EXPECT_EQ(enough->amount, 0);
}

TEST(Develop, SaysWhenALimitIsOutOfReach) {
  const Piece piece = test::patchOf(test::saddle(20, 10, 0.01));
  const Result<DevelopedPiece> developed = develop(piece, {.maxAreaError = Ratio::percent(1)});
  ASSERT_TRUE(developed) << developed.error();
  ASSERT_FALSE(developed->findings.empty());
  EXPECT_EQ(developed->findings[0].code, "develop-over-limit");
}

TEST(Develop, StaysOutsideTheBody) {
  const Piece piece = test::patchOf(torusPatch(), middleLine());
  // The body is the whole ring, 2 mm thinner than the patch, so that there is room to move in.
  const auto body = std::make_shared<const Mesh>(test::torus(100, 48, 96, 64));
  const auto index = std::make_shared<const SurfaceIndex>(body);
  const Result<DevelopedPiece> free = develop(piece);
  ASSERT_TRUE(free) << free.error();
  const auto nearest = [&](const DevelopedPiece& developed) {
    double least = 1e300;
    for (std::size_t i = 0; i < developed.piece.mesh->vertexCount(); ++i) {
      if (developed.piece.mesh->isBorder(VertexId(i))) continue;
      least =
          std::min(least, developing::signedDistance(*index, developed.piece.mesh->positions()[i]));
    }
    return least;
  };
  ASSERT_LT(nearest(*free), 0) << "without the body the patch goes inwards";
  const Result<DevelopedPiece> held = develop(piece, {.outsideOf = index, .gap = Length::mm(1)});
  ASSERT_TRUE(held) << held.error();
  EXPECT_GE(nearest(*held), 1 - 1e-9);
  EXPECT_EQ(*held->report.clearance, nearest(*held));
  expectBorderUnmoved(piece, held->piece);
}

TEST(Develop, AnglesOfABoxCorner) {
  const Mesh cube = test::cube(10, 2);
  const VertexData<double> defect = angleDefects(cube);
  double sum = 0;
  int corners = 0;
  for (const double d : defect.values()) {
    sum += d;
    if (std::abs(d - std::numbers::pi / 2) < 1e-12) ++corners;
  }
  EXPECT_EQ(corners, 8);
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-10);
}

TEST(Develop, RefusesWhatCannotBeMeant) {
  const Piece piece = test::patchOf(test::grid(4, 4));
  for (const DevelopOptions& options :
       {DevelopOptions{.amount = 1.5}, DevelopOptions{.amount = std::nan("")},
        DevelopOptions{.maxAreaError = Ratio::of(0)}, DevelopOptions{.gap = Length::mm(-1)}}) {
    const Result<DevelopedPiece> developed = develop(piece, options);
    ASSERT_FALSE(developed);
    EXPECT_EQ(developed.error().code, ErrorCode::InvalidArgument);
  }
  const Result<DevelopedPiece> tube = develop(test::patchOf(test::cylinder(50, 100, 16, 4)));
  ASSERT_FALSE(tube);
  EXPECT_EQ(tube.error().code, ErrorCode::NotADisk);
}

TEST(Develop, HalvesTheErrorOfALegAndStaysSmooth) {
  TOILE_TEST_DATA_OR_SKIP(path, "patches/body_legfront.obj");
  const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(file) << file.error();
  const Result<DevelopedPiece> developed = develop(test::patchOf(file->mesh));
  ASSERT_TRUE(developed) << developed.error();
  EXPECT_LT(developed->report.errorAgainstProcessed, 0.5 * developed->report.errorBefore);
  EXPECT_LE(developed->report.roughness, 1.5 * developed->report.roughnessBefore);
}

}  // namespace
}  // namespace toile
