// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/develop/darts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"

namespace toile {
namespace {

Patch patchOfMesh(const Mesh& mesh) {
  return {mesh, {}, {}, {}};
}

/// Radius 100: a square grid drawn round, so that its border is the equator.
Mesh hemisphere(int n = 24) {
  const Mesh plane = test::grid(n, n, 2.0 / n);
  std::vector<Eigen::Vector3d> at;
  for (const Eigen::Vector3d& p : plane.positions()) {
    const double x = p.x() - 1, y = p.y() - 1;
    const double r = std::max(std::abs(x), std::abs(y));
    const double turn = r == 0 ? 0 : std::atan2(y, x);
    const double polar = r * std::numbers::pi / 2;
    at.emplace_back(100 * std::sin(polar) * std::cos(turn), 100 * std::sin(polar) * std::sin(turn),
                    100 * std::cos(polar));
  }
  return plane.withPositions(std::move(at));
}

TEST(ForcedError, OfAHemisphereIsHalfItsArea) {
  const Piece piece = test::patchOf(hemisphere());
  const Result<ForcedError> forced = measureForcedError(piece);
  ASSERT_TRUE(forced) << forced.error();
  EXPECT_NEAR(forced->bound, 0.5, 0.01);
  // The corners of the square have nearly straight angles, where cotangents are cut off.
  EXPECT_NEAR(forced->estimate, 0.5, 0.06);
  EXPECT_GT(forced->bulge, 0.5);
  EXPECT_GT(piece.mesh->position(forced->apex).z(), 95);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_GE(flat->meanAreaError, forced->bound - 1e-9);
}

TEST(ForcedError, IsZeroWhereNothingIsCurved) {
  const Result<ForcedError> forced =
      measureForcedError(test::patchOf(test::halfCylinder(80, 300, 16, 20)));
  ASSERT_TRUE(forced) << forced.error();
  EXPECT_EQ(forced->bound, 0);
  EXPECT_LT(forced->estimate, 1e-12);
  EXPECT_NEAR(forced->totalCurvature, 0, 1e-9);
}

TEST(ForcedError, CountsEveryRegionBetweenWires) {
  const Mesh dome = test::heightField(20, 20, 10, [](double x, double y) {
    return 60 * std::sin(x * std::numbers::pi / 200) * std::sin(y * std::numbers::pi / 200);
  });
  PolygonSoup::Chain line{"wire_feature_middle", {}, 0};
  for (std::uint32_t i = 0; i <= 20; ++i) line.vertices.push_back(10 * 21 + i);
  const Result<ForcedError> plain = measureForcedError(test::patchOf(dome));
  const Result<ForcedError> halved = measureForcedError(test::patchOf(dome, {line}));
  ASSERT_TRUE(plain && halved);
  EXPECT_LT(halved->estimate, plain->estimate);
  EXPECT_NEAR(halved->totalCurvature, plain->totalCurvature, 1e-9);
}

TEST(Darts, OpenAHemisphereUntilTheLimitHolds) {
  const Mesh mesh = hemisphere();
  const Result<AutoDart> made = autoDart(patchOfMesh(mesh), "bowl", Ratio::percent(5));
  ASSERT_TRUE(made) << made.error();
  EXPECT_GT(made->errorBefore, 0.4);
  EXPECT_LE(made->flat->meanAreaError, 0.05);
  EXPECT_TRUE(made->flat->check.passes());
  std::vector<double> turns;  // of the mouths round the pole
  for (const DartProposal& dart : made->darts) {
    EXPECT_EQ(dart.kind, DartProposal::Kind::Dart);
    EXPECT_GT(dart.intake, 10);
    EXPECT_LT(dart.errorAfter, 0.9 * dart.errorBefore);
    std::vector<SurfacePath> paths = dart.companions;
    paths.push_back(dart.path);
    for (const SurfacePath& path : paths) {
      const Eigen::Vector3d mouth = position(mesh, path.points.front());
      turns.push_back(std::atan2(mouth.y(), mouth.x()));
    }
  }
  // As a toy maker would put them: evenly round the equator.
  ASSERT_GE(turns.size(), 2U);
  EXPECT_LE(turns.size(), 6U);
  std::sort(turns.begin(), turns.end());
  turns.push_back(turns.front() + 2 * std::numbers::pi);
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double even = 2 * std::numbers::pi / static_cast<double>(turns.size() - 1);
    EXPECT_NEAR(turns[i + 1] - turns[i], even, 0.1 * even);
  }
  // The two sides of a dart are sewn together: their edges have the same lengths.
  for (std::size_t d = 1; d < turns.size(); ++d) {
    std::vector<const Wire*> sides;
    for (const Wire& wire : made->piece.wires) {
      if (wire.curve == "autodart-" + std::to_string(d)) sides.push_back(&wire);
    }
    ASSERT_EQ(sides.size(), 2U);
    std::vector<double> back = sides[1]->targetLength;
    std::reverse(back.begin(), back.end());
    EXPECT_EQ(sides[0]->targetLength, back);
  }
  // Faces are only re-cut: each part lies in its source, together they are as large.
  ASSERT_EQ(made->patch.sourceFace.size(), made->patch.mesh.faceCount());
  FaceData<double> area(mesh.faceCount(), 0.0);
  for (std::size_t f = 0; f < made->patch.mesh.faceCount(); ++f) {
    area[made->patch.sourceFace[FaceId(f)]] += made->patch.mesh.area(FaceId(f));
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    EXPECT_NEAR(area[FaceId(f)], mesh.area(FaceId(f)), 1e-6 * mesh.area(FaceId(f)));
  }
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    EXPECT_EQ(made->patch.mesh.position(VertexId(v)), mesh.position(VertexId(v)));
  }
}

/// Symmetric in x = 0, a ridge with its summit off the centre: lines come in pairs or on the
/// middle.
TEST(Darts, OfASymmetricPieceAreItsMirrorImages) {
  const Mesh ridge = test::heightField(20, 20, 10, [](double x, double y) {
    const double u = (x - 100) / 45, v = (y - 70) / 60;
    return 60 * std::exp(-u * u - v * v);
  });
  const Piece piece = test::patchOf(ridge);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const auto proposals = adviseDarts(piece, *flat);
  ASSERT_TRUE(proposals) << proposals.error();
  ASSERT_FALSE(proposals->empty());
  bool hasPair = false;
  for (const DartProposal& proposal : *proposals) {
    if (proposal.kind == DartProposal::Kind::Cut) continue;
    EXPECT_TRUE(proposal.isSymmetric);
    const Eigen::Vector3d mouth = position(ridge, proposal.path.points.front());
    if (proposal.companions.empty()) {
      EXPECT_NEAR(mouth.x(), 100, 5);
      continue;
    }
    hasPair = true;
    ASSERT_EQ(proposal.companions.size(), 1U);
    const Eigen::Vector3d other = position(ridge, proposal.companions[0].points.front());
    EXPECT_NEAR(mouth.x() + other.x(), 200, 1e-6);
    EXPECT_NEAR(mouth.y(), other.y(), 1e-6);
  }
  EXPECT_TRUE(hasPair);
}

/// Two bumps on the middle: the shortest way from the edge to the farther one goes round the nearer
/// one, the middle over it.
TEST(Darts, OnTheMiddleStayThere) {
  const Mesh bumps = test::heightField(20, 20, 10, [](double x, double y) {
    const double u = (x - 100) / 25, v = (y - 50) / 25, w = (y - 120) / 30;
    return 45 * std::exp(-u * u - v * v) + 60 * std::exp(-u * u - w * w);
  });
  const Piece piece = test::patchOf(bumps);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const auto proposals = adviseDarts(piece, *flat);
  ASSERT_TRUE(proposals) << proposals.error();
  bool isOverBump = false;
  for (const DartProposal& proposal : *proposals) {
    if (proposal.kind == DartProposal::Kind::Cut || !proposal.companions.empty()) continue;
    for (const SurfacePoint& point : proposal.path.points) {
      const Eigen::Vector3d at = position(bumps, point);
      EXPECT_NEAR(at.x(), 100, 1);
      if (at.y() > 40 && at.y() < 60) isOverBump = true;
    }
  }
  EXPECT_TRUE(isOverBump);
}

TEST(Darts, AreNotPutWhereNoneIsNeeded) {
  const Result<AutoDart> made =
      autoDart(patchOfMesh(test::halfCylinder(80, 300, 16, 20)), "sleeve", Ratio::percent(5));
  ASSERT_TRUE(made) << made.error();
  EXPECT_TRUE(made->darts.empty());
  EXPECT_TRUE(made->findings.empty());
}

TEST(Darts, ASaddleWantsAGusset) {
  const Result<AutoDart> made =
      autoDart(patchOfMesh(test::saddle(20, 10, 0.02)), "crotch", Ratio::percent(2));
  ASSERT_TRUE(made) << made.error();
  EXPECT_LT(made->forced.bulge, 0);
  EXPECT_TRUE(made->darts.empty());
  ASSERT_EQ(made->findings.size(), 1U);
  EXPECT_EQ(made->findings[0].code, "needs-cut");
  EXPECT_THAT(made->findings[0].message, testing::HasSubstr("gusset"));
}

TEST(Darts, TheErrorAfterACutIsMeasuredOnBothParts) {
  const Piece piece = test::patchOf(test::saddle(20, 10, 0.02));
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const auto proposals = adviseDarts(piece, *flat);
  ASSERT_TRUE(proposals) << proposals.error();
  ASSERT_FALSE(proposals->empty());
  const DartProposal& best = proposals->front();
  EXPECT_EQ(best.kind, DartProposal::Kind::Cut);
  // Parted through its middle a saddle leaves two of half the width.
  const Result<FlatPiece> half =
      unfold(test::patchOf(test::heightField(20, 10, 10, [](double x, double y) {
        return 0.01 * ((x - 100) * (x - 100) - (y - 100) * (y - 100));
      })));
  ASSERT_TRUE(half) << half.error();
  EXPECT_LT(best.errorAfter, 0.9 * best.errorBefore);
  EXPECT_NEAR(best.errorAfter / half->meanAreaError, 1, 0.6);
}

/// A strip that winds once and 54 degrees more round its middle, waved at both edges.
Mesh spiral() {
  constexpr int kRows = 8, kSegments = 96;
  const Mesh strip = test::grid(kRows, kSegments, 1);
  std::vector<Eigen::Vector3d> at;
  for (const Eigen::Vector3d& p : strip.positions()) {
    const double turn = 2 * std::numbers::pi * 1.15 * p.y() / kSegments;
    const double radius = 40 + 60 * p.x() / kRows, side = (radius - 70) / 30;
    at.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                    6 * turn + 5 * side * side * std::cos(3 * turn));
  }
  return strip.withPositions(std::move(at));
}

TEST(Darts, APieceThatLiesOnItselfGetsALineThatOpensIt) {
  const Piece piece = test::patchOf(spiral());
  const UnfoldOptions asItLies{.keepApart = false};
  const Result<FlatPiece> flat = unfold(piece, asItLies);
  ASSERT_TRUE(flat) << flat.error();
  ASSERT_GT(flat->check.crossings, 0U);
  ASSERT_LT(flat->meanAreaError, 0.01) << "strain alone asks for nothing";
  const auto proposals = adviseDarts(piece, *flat, {.unfold = asItLies});
  ASSERT_TRUE(proposals) << proposals.error();
  EXPECT_FALSE(proposals->empty());
  const Result<AutoDart> made = autoDart(patchOfMesh(spiral()), "spiral", Ratio::percent(50));
  ASSERT_TRUE(made) << made.error();
  ASSERT_FALSE(made->findings.empty());
  EXPECT_THAT(made->findings.back().message, testing::HasSubstr("lies on itself"));
}

TEST(Darts, CrossNoLineOfThePiece) {
  const Mesh dome = test::heightField(20, 20, 10, [](double x, double y) {
    return 70 * std::sin(x * std::numbers::pi / 200) * std::sin(y * std::numbers::pi / 200);
  });
  PolygonSoup::Chain line{"wire_feature_quarter", {}, 0};
  for (std::uint32_t i = 0; i <= 20; ++i) line.vertices.push_back(5 * 21 + i);
  const Piece piece = test::patchOf(dome, {line});
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const auto proposals = adviseDarts(piece, *flat);
  ASSERT_TRUE(proposals) << proposals.error();
  ASSERT_FALSE(proposals->empty());
  for (const DartProposal& proposal : *proposals) {
    const double mouth = position(dome, proposal.path.points.front()).y();
    for (const SurfacePoint& p : proposal.path.points) {
      EXPECT_EQ(position(dome, p).y() > 50, mouth > 50);
    }
    EXPECT_LT(proposal.errorAfter, proposal.errorBefore);
  }
  EXPECT_TRUE(std::is_sorted(
      proposals->begin(), proposals->end(),
      [](const DartProposal& a, const DartProposal& b) { return a.errorAfter < b.errorAfter; }));
}

TEST(Darts, RefusesOptionsOutOfRange) {
  const Piece piece = test::patchOf(test::grid(4, 4));
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat);
  const auto refused = adviseDarts(piece, *flat, {.maxProposals = 0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace toile
