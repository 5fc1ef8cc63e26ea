// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"

namespace toile {
namespace {

using testing::ElementsAre;

std::vector<std::uint32_t> indices(const Wire& wire) {
  std::vector<std::uint32_t> result;
  for (const VertexId v : wire.vertices) result.push_back(v.index());
  return result;
}

TEST(MakePiece, ABorderAloneIsOneClosedWire) {
  const Piece piece = test::patchOf(test::grid(2, 1));
  ASSERT_EQ(piece.wires.size(), 1U);
  EXPECT_EQ(piece.wires[0].kind, WireKind::Border);
  EXPECT_EQ(piece.wires[0].curve, "border");
  EXPECT_THAT(indices(piece.wires[0]), ElementsAre(0, 1, 2, 5, 4, 3, 0));
  EXPECT_EQ(piece.wires[0].targetLength, std::vector<double>(6, 10.0));
}

TEST(MakePiece, AFeatureSplitsTheBorderAndTakesItsTargets) {
  const Piece piece = test::patchOf(test::grid(2, 2), {{"wire_feature_mid", {1, 4, 7}}},
                                    {{"wire_feature_mid 1", 11.5}});
  ASSERT_EQ(piece.wires.size(), 3U);
  EXPECT_THAT(indices(piece.wires[0]), ElementsAre(1, 2, 5, 8, 7));
  EXPECT_THAT(indices(piece.wires[1]), ElementsAre(7, 6, 3, 0, 1));
  EXPECT_EQ(piece.wires[1].part, 1);
  EXPECT_EQ(piece.wires[2].kind, WireKind::Feature);
  EXPECT_EQ(piece.wires[2].curve, "mid");
  EXPECT_THAT(piece.wires[2].targetLength, ElementsAre(10, 11.5));
  EXPECT_THAT(piece.wires[2].bodyLength, ElementsAre(10, 10));
}

TEST(MakePiece, CrossingFeaturesMeetInAJunction) {
  const Piece piece =
      test::patchOf(test::grid(2, 2), {{"wire_feature_a", {1, 4, 7}}, {"", {3, 4, 5}}});
  ASSERT_EQ(piece.wires.size(), 8U);
  EXPECT_THAT(indices(piece.wires[4]), ElementsAre(1, 4));
  EXPECT_THAT(indices(piece.wires[5]), ElementsAre(4, 7));
  EXPECT_EQ(piece.wires[6].curve, "chain-2");
}

TEST(MakePiece, ADartOpensTheSurfaceUpToItsTip) {
  const Mesh mesh = test::grid(4, 2);
  const Piece piece = test::patchOf(mesh, {{"wire_dart_d", {2, 7}}});
  EXPECT_EQ(piece.mesh->vertexCount(), mesh.vertexCount() + 1);
  EXPECT_EQ(piece.mesh->faceCount(), mesh.faceCount());
  EXPECT_EQ(piece.onModel[VertexId(15)].at, SurfacePoint{VertexId(2)}.at);
  std::vector<std::vector<std::uint32_t>> sides;
  for (const Wire& wire : piece.wires) {
    if (wire.kind == WireKind::Dart) sides.push_back(indices(wire));
  }
  ASSERT_EQ(sides.size(), 2U);
  for (const auto& side : sides) EXPECT_EQ(side.size(), 2U);
  EXPECT_NE(sides[0], sides[1]);
  EXPECT_EQ(sides[0].back() == 7, sides[1].front() == 7);
}

TEST(MakePiece, RefusesStepsOffTheMeshAndUnknownKinds) {
  for (const PolygonSoup::Chain& chain :
       {PolygonSoup::Chain{"", {0, 8}}, PolygonSoup::Chain{"", {0, 99}},
        PolygonSoup::Chain{"", {0}}, PolygonSoup::Chain{"wire_zipper_a", {0, 1}}}) {
    const Result<Piece> piece = makePiece("p", test::grid(2, 2), {chain});
    ASSERT_FALSE(piece);
    EXPECT_EQ(piece.error().code, ErrorCode::CurveInvalid);
    EXPECT_FALSE(piece.error().where.empty());
  }
}

TEST(WritePatchObj, KeepsVerticesFacesAndChainsAndGivesADartTwoSides) {
  const Mesh mesh = test::grid(4, 2);
  const std::vector<PolygonSoup::Chain> chains = {{"wire_dart_d", {2, 7}}, {"", {5, 6}}};
  const std::map<std::string, double> targets = {{"wire_dart_d 0", 10.25}};
  const Piece piece = test::patchOf(mesh, chains, targets);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  const Result<PolygonSoup> soup =
      parsePolygonSoup(writePatchObj(mesh, chains, targets, piece, *flat), "patch.obj");
  ASSERT_TRUE(soup) << soup.error();
  EXPECT_EQ(soup->positions, mesh.positions());
  ASSERT_EQ(soup->polygons.size(), mesh.faceCount());
  EXPECT_EQ(soup->polygons[3][0], mesh.triangles()[3][0].index());
  EXPECT_EQ(soup->unit, FileUnit::Millimetre);
  ASSERT_EQ(soup->chains.size(), 2U);
  EXPECT_EQ(soup->chains[1].group, "wire_feature_chain-2");
  EXPECT_EQ(soup->targets, targets);
  const std::string text = writePatchObj(mesh, chains, targets, piece, *flat);
  std::size_t planes = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) planes += line.starts_with("vt ") ? 1 : 0;
  EXPECT_EQ(planes, mesh.vertexCount() + 1);
}

}  // namespace
}  // namespace toile
