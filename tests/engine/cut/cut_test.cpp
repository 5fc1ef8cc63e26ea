// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/cut/cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "support/cut_checks.h"
#include "support/drawn_curves.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using test::areaOf;
using test::drawn;
using test::expectGluesBack;
using test::expectSoundWires;
using test::lengthOf;
using test::planeSections;
using testing::ElementsAre;

Document documentOf(Mesh mesh, std::vector<PieceRecord> records = {}) {
  auto model = std::make_shared<ReferenceModel>();
  model->mesh = std::make_shared<const Mesh>(std::move(mesh));
  auto design = std::make_shared<Design>();
  design->pieces = std::move(records);
  return {design, model};
}

/// Of a model's one piece.
Result<std::vector<StylingCurve>> proposedCuts(const Document& document) {
  const Result<CutResult> result = cut(document, {});
  if (!result) return result.error();
  return proposeCuts(result->pieces[0], *document.model);
}

PieceRecord recordAt(std::string id, FaceId face) {
  PieceRecord record;
  record.id = std::move(id);
  record.anchor = ModelPoint{SurfacePoint::InFace{face, Eigen::Vector3d(0.25, 0.25, 0.5)}};
  return record;
}

std::vector<std::string> codes(const CutResult& result) {
  std::vector<std::string> found;
  for (const Finding& f : result.findings) found.push_back(f.code);
  return found;
}

TEST(Cut, DividesASphereInTwo) {
  const Mesh mesh = test::icosphere(100, 3);
  const Document document = documentOf(mesh);
  const auto section = planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 3.0);
  const auto result = cut(document, std::vector{drawn("girth", CurveKind::Seam, section.at(0))});
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces.size(), 2U);
  expectSoundWires(*result);
  expectGluesBack(mesh, *result);
  for (const Piece& piece : result->pieces) {
    EXPECT_TRUE(topology(piece).isDisk());
    ASSERT_EQ(piece.wires.size(), 1U);
    EXPECT_EQ(piece.wires[0].kind, WireKind::Seam);
    EXPECT_EQ(piece.wires[0].curve, "girth");
    EXPECT_EQ(piece.wires[0].vertices.front(), piece.wires[0].vertices.back());
    const double radius = std::sqrt(100.0 * 100.0 - 3.0 * 3.0 / 1.05);
    EXPECT_NEAR(lengthOf(piece.wires[0]), 2 * std::numbers::pi * radius, 5);
  }
  ASSERT_EQ(result->mates.size(), 1U);
  EXPECT_NE(result->mates[0].pieceA, result->mates[0].pieceB);
  EXPECT_NEAR(result->includedArea, areaOf(mesh), 1e-12 * areaOf(mesh));
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece"));
}

// One horizontal and two vertical planes through a cube: eight corners of it, each with three
// seams, and where the planes meet the surface cross nodes.
TEST(Cut, DividesACubeInEight) {
  const Mesh mesh = test::cube(100, 4);
  std::vector<PlacedCurve> curves;
  for (int axis = 0; axis < 3; ++axis) {
    const auto section = planeSections(mesh, Eigen::Vector3d::Unit(axis), 40);
    curves.push_back(
        drawn(std::string(1, static_cast<char>('x' + axis)), CurveKind::Seam, section.at(0)));
  }
  const auto result = cut(documentOf(mesh), curves);
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces.size(), 8U);
  expectSoundWires(*result);
  expectGluesBack(mesh, *result);
  std::multiset<double> areas;
  for (const Piece& piece : result->pieces) {
    EXPECT_TRUE(topology(piece).isDisk());
    EXPECT_EQ(piece.wires.size(), 3U);
    areas.insert(std::round(areaOf(*piece.mesh) * 1e-3) * 1e3);
  }
  // 40/60 splits: corner cells a x b x c have three faces each.
  EXPECT_THAT(areas, ElementsAre(5000, 6000, 6000, 6000, 8000, 8000, 8000, 11000));
  EXPECT_EQ(result->mates.size(), 12U);
}

TEST(Cut, OpensATubeAlongASeam) {
  const Mesh mesh = test::cylinder(50, 200, 24, 10);
  std::vector<VertexId> line;
  for (std::size_t j = 0; j <= 10; ++j) line.emplace_back(j * 24);
  const auto result = cut(documentOf(mesh),
                          std::vector{drawn("back", CurveKind::Seam, test::edgePath(mesh, line))});
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces.size(), 1U);
  expectSoundWires(*result);
  expectGluesBack(mesh, *result);
  EXPECT_TRUE(topology(result->pieces[0]).isDisk());
  // Up the seam, around the top, down the seam, around the bottom.
  ASSERT_EQ(result->pieces[0].wires.size(), 4U);
  ASSERT_EQ(result->mates.size(), 1U);
  EXPECT_EQ(result->mates[0].pieceA, result->mates[0].pieceB);
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece"));
}

TEST(Cut, SaysThatATubeNeedsACutAndProposesTheShortest) {
  const Mesh mesh = test::cylinder(50, 200, 24, 10);
  const Document document = documentOf(mesh);
  const auto result = cut(document, {});
  ASSERT_TRUE(result) << result.error();
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece", "tube-without-cut"));
  ASSERT_EQ(result->pieces.size(), 1U);
  const PieceTopology shape = topology(result->pieces[0]);
  EXPECT_EQ(shape.boundaryLoops, 2U);
  EXPECT_EQ(shape.holes, 0U);
  EXPECT_FALSE(shape.canLieFlat());
  const auto cuts = proposeCuts(result->pieces[0], *document.model);
  ASSERT_TRUE(cuts) << cuts.error();
  ASSERT_EQ(cuts->size(), 1U);
  EXPECT_EQ((*cuts)[0].id, "autocut-piece-1-1");

  std::vector<SurfacePoint> points;
  for (const ModelPoint& p : (*cuts)[0].dataPoints) points.push_back(*toSurfacePoint(mesh, p));
  const SurfacePath path = test::pathThrough(mesh, points);
  EXPECT_NEAR(length(mesh, path), 200, 1e-9);
  const auto opened = cut(document, std::vector{drawn((*cuts)[0].id, CurveKind::Seam, path)});
  ASSERT_TRUE(opened) << opened.error();
  EXPECT_TRUE(topology(opened->pieces.at(0)).isDisk());
}

// A tube that is cut off obliquely: the shortest cut is the side where it is shortest, straight
// along the axis, wherever the diagonals of the mesh lead.
TEST(Cut, ProposesACutWhereATubeIsShortest) {
  const Mesh straight = test::cylinder(50, 200, 40, 12);
  std::vector<Eigen::Vector3d> positions = straight.positions();
  for (Eigen::Vector3d& p : positions) p.z() *= 1 + 0.4 * p.x() / 50 - 0.1 * p.y() / 50;
  const Mesh mesh = straight.withPositions(positions);
  const auto cuts = proposedCuts(documentOf(mesh));
  ASSERT_TRUE(cuts) << cuts.error();
  ASSERT_EQ(cuts->size(), 1U);
  std::vector<SurfacePoint> points;
  for (const ModelPoint& p : (*cuts)[0].dataPoints) points.push_back(*toSurfacePoint(mesh, p));
  // The shortest of the mesh's 40 lines along the axis.
  double shortest = 1e300;
  for (std::size_t i = 0; i < 40; ++i) {
    const double z = mesh.position(VertexId(12 * 40 + i)).z();
    shortest = std::min(shortest, z);
  }
  EXPECT_LE(length(mesh, test::pathThrough(mesh, points)), shortest + 1e-9);
}

// A pair of trousers without seams has three open ends: two cuts make it lie flat.
TEST(Cut, ProposesTwoCutsForTrousers) {
  const Mesh mesh = test::trousers();
  const Document document = documentOf(mesh);
  const auto cuts = proposedCuts(document);
  ASSERT_TRUE(cuts) << cuts.error();
  ASSERT_EQ(cuts->size(), 2U);
  std::vector<PlacedCurve> curves;
  for (const StylingCurve& c : *cuts) {
    std::vector<SurfacePoint> points;
    for (const ModelPoint& p : c.dataPoints) points.push_back(*toSurfacePoint(mesh, p));
    curves.push_back(drawn(c.id, c.kind, test::pathThrough(mesh, points)));
  }
  const auto opened = cut(document, curves);
  ASSERT_TRUE(opened) << opened.error();
  expectSoundWires(*opened);
  ASSERT_EQ(opened->pieces.size(), 1U);
  EXPECT_TRUE(topology(opened->pieces[0]).isDisk());
}

// A tube that is its own mirror image, longest in the middle: its shortest way runs down one side,
// and the piece would be lopsided.
TEST(Cut, ProposesACutOnTheMiddleOfASymmetricTube) {
  const Mesh straight = test::cylinder(50, 200, 40, 12);
  std::vector<Eigen::Vector3d> positions = straight.positions();
  for (Eigen::Vector3d& p : positions) {
    p.z() *= 1 - 0.2 * std::abs(p.x()) / 50 - 0.05 * p.y() / 50;
    p.x() *= 1.5;
  }
  const Mesh mesh = straight.withPositions(positions);
  const auto cuts = proposedCuts(documentOf(mesh));
  ASSERT_TRUE(cuts) << cuts.error();
  ASSERT_EQ(cuts->size(), 1U);
  for (const ModelPoint& p : (*cuts)[0].dataPoints) {
    const Eigen::Vector3d at = position(mesh, *toSurfacePoint(mesh, p));
    EXPECT_NEAR(at.x(), 0, 1e-6);
    EXPECT_GT(at.y(), 0) << "the shorter of both ways";
  }
}

// Both legs of trousers are joined to the waist, each on its side.
TEST(Cut, ProposesCutsInPairsForASymmetricPiece) {
  const Mesh mesh = test::trousers();
  const auto cuts = proposedCuts(documentOf(mesh));
  ASSERT_TRUE(cuts) << cuts.error();
  ASSERT_EQ(cuts->size(), 2U);
  const auto tip = [&](std::size_t cut, bool atStart) {
    const auto& points = (*cuts)[cut].dataPoints;
    return position(mesh, *toSurfacePoint(mesh, atStart ? points.front() : points.back()));
  };
  for (const bool atStart : {false, true}) {
    const Eigen::Vector3d a = tip(0, atStart), b = tip(1, atStart);
    EXPECT_LT((Eigen::Vector3d(-a.x(), a.y(), a.z()) - b).norm(), 1e-6);
  }
}

TEST(Cut, RefusesToProposeCutsForHandlesAndClosedSurfaces) {
  for (const Mesh& mesh : {test::torus(60, 20, 16, 9), test::icosphere(50, 1)}) {
    const Document document = documentOf(mesh);
    const auto result = cut(document, {});
    ASSERT_TRUE(result) << result.error();
    EXPECT_EQ(codes(*result).back(), "closed-without-cut");
    const auto cuts = proposeCuts(result->pieces[0], *document.model);
    ASSERT_FALSE(cuts);
    EXPECT_EQ(cuts.error().code, ErrorCode::NotADisk);
    EXPECT_EQ(cuts.error().where.at(0), Element::piece("piece-1"));
  }
}

TEST(Cut, KeepsAnArmholeAsAHole) {
  const Mesh mesh = test::grid(10, 10);
  std::vector<VertexId> square;
  for (int i = 3; i < 7; ++i) square.emplace_back(3U * 11U + static_cast<unsigned>(i));
  for (int j = 3; j < 7; ++j) square.emplace_back(static_cast<unsigned>(j) * 11U + 7U);
  for (int i = 7; i > 3; --i) square.emplace_back(7U * 11U + static_cast<unsigned>(i));
  for (int j = 7; j > 3; --j) square.emplace_back(static_cast<unsigned>(j) * 11U + 3U);
  const auto result =
      cut(documentOf(mesh),
          std::vector{drawn("hole", CurveKind::Seam, test::edgePath(mesh, square, true))});
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces.size(), 2U);
  expectSoundWires(*result);
  expectGluesBack(mesh, *result);
  const PieceTopology ring = topology(result->pieces[0]);
  EXPECT_EQ(ring.boundaryLoops, 2U);
  EXPECT_EQ(ring.holes, 1U);
  EXPECT_TRUE(ring.canLieFlat());
  EXPECT_TRUE(topology(result->pieces[1]).isDisk());
}

TEST(Cut, OpensADartOnBothSides) {
  const Mesh mesh = test::grid(10, 10);
  std::vector<VertexId> line;
  for (unsigned j = 0; j <= 4; ++j) line.emplace_back(j * 11U + 5U);
  const auto result = cut(documentOf(mesh),
                          std::vector{drawn("bust", CurveKind::Dart, test::edgePath(mesh, line))});
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces.size(), 1U);
  expectSoundWires(*result);
  expectGluesBack(mesh, *result);
  EXPECT_TRUE(topology(result->pieces[0]).isDisk());
  std::vector<const Wire*> sides;
  for (const Wire& w : result->pieces[0].wires) {
    if (w.kind == WireKind::Dart) sides.push_back(&w);
  }
  ASSERT_EQ(sides.size(), 2U);
  EXPECT_EQ(lengthOf(*sides[0]), 40);
  EXPECT_EQ(lengthOf(*sides[1]), 40);
  EXPECT_THAT(result->mates, testing::SizeIs(1));
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece"));
}

TEST(Cut, SaysWhereASeamEndsInsideAPiece) {
  const Mesh mesh = test::grid(10, 10);
  std::vector<VertexId> line;
  for (unsigned j = 0; j <= 4; ++j) line.emplace_back(j * 11U + 5U);
  const auto result =
      cut(documentOf(mesh), std::vector{drawn("s", CurveKind::Seam, test::edgePath(mesh, line))});
  ASSERT_TRUE(result) << result.error();
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece", "open-cut-end"));
}

// A cut of one edge with both ends inside cannot be a slit between two vertices.
TEST(Cut, OpensALoneShortCut) {
  const Mesh mesh = test::grid(10, 10);
  const FaceId face(57);
  SurfacePath inside;
  inside.points = {makeSurfacePoint(mesh, face, {0.6, 0.2, 0.2}),
                   makeSurfacePoint(mesh, face, {0.2, 0.2, 0.6})};
  inside.faceOfSegment = {face};
  for (const SurfacePath& path :
       {inside, test::edgePath(mesh, {VertexId(5 * 11 + 5), VertexId(5 * 11 + 6)})}) {
    const auto result = cut(documentOf(mesh), std::vector{drawn("slit", CurveKind::Dart, path)});
    ASSERT_TRUE(result) << result.error();
    expectSoundWires(*result);
    expectGluesBack(mesh, *result);
    ASSERT_EQ(result->pieces.size(), 1U);
    EXPECT_EQ(topology(result->pieces[0]).boundaryLoops, 2U);
  }
}

TEST(Cut, RunsInnerWiresAlongTheirCurves) {
  const Mesh mesh = test::grid(10, 10);
  const auto seam = planeSections(mesh, Eigen::Vector3d::UnitX(), 52);
  const auto feature = planeSections(mesh, Eigen::Vector3d::UnitY(), 33);
  const auto result =
      cut(documentOf(mesh), std::vector{drawn("s", CurveKind::Seam, seam.at(0)),
                                        drawn("f", CurveKind::Feature, feature.at(0))});
  ASSERT_TRUE(result) << result.error();
  expectSoundWires(*result);
  ASSERT_EQ(result->pieces.size(), 2U);
  const Eigen::Vector3d way =
      position(mesh, feature[0].points.back()) - position(mesh, feature[0].points.front());
  double length = 0;
  for (const Piece& piece : result->pieces) {
    const Wire& inner = piece.wires.back();
    ASSERT_EQ(inner.kind, WireKind::Feature);
    EXPECT_EQ(inner.curve, "f");
    EXPECT_EQ(inner.part, 0);
    const Eigen::Vector3d runs =
        piece.mesh->position(inner.vertices.back()) - piece.mesh->position(inner.vertices.front());
    EXPECT_GT(runs.dot(way), 0);
    length += lengthOf(inner);
  }
  EXPECT_NEAR(length, 100, 1e-9);
}

TEST(Cut, CountsTheRunsOfAClosedFeature) {
  const Mesh mesh = test::icosphere(100, 3);
  const auto seam = planeSections(mesh, Eigen::Vector3d(0, 0.05, 1), 1.0);
  const auto ring = planeSections(mesh, Eigen::Vector3d(1, 0.02, 0.03), 1.0);
  const auto result =
      cut(documentOf(mesh), std::vector{drawn("s", CurveKind::Seam, seam.at(0)),
                                        drawn("r", CurveKind::Elastic, ring.at(0))});
  ASSERT_TRUE(result) << result.error();
  expectSoundWires(*result);
  for (const Piece& piece : result->pieces) {
    ASSERT_EQ(piece.wires.size(), 2U);
    EXPECT_EQ(piece.wires[1].kind, WireKind::Elastic);
  }
}

TEST(Cut, GivesPiecesTheirRecords) {
  const Mesh mesh = test::grid(12, 4);
  const auto a = planeSections(mesh, Eigen::Vector3d::UnitX(), 41);
  const auto b = planeSections(mesh, Eigen::Vector3d::UnitX(), 83);
  const FaceId left(0);
  const FaceId middle(12);
  const FaceId alsoMiddle(14);
  PieceRecord leftOut = recordAt("left", left);
  leftOut.include = false;
  const Document document =
      documentOf(mesh, {recordAt("middle", middle), leftOut, recordAt("second", alsoMiddle)});
  const auto result = cut(document, std::vector{drawn("a", CurveKind::Seam, a.at(0)),
                                                drawn("b", CurveKind::Seam, b.at(0))});
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces.size(), 3U);
  EXPECT_EQ(result->pieces[0].id, "middle");
  EXPECT_THAT(result->pieces[0].recordIndices, ElementsAre(0, 2));
  EXPECT_EQ(result->pieces[1].id, "left");
  EXPECT_FALSE(result->pieces[1].include);
  EXPECT_EQ(result->pieces[2].id, "piece-1");
  EXPECT_THAT(result->pieces[2].recordIndices, testing::IsEmpty());
  EXPECT_THAT(codes(*result), ElementsAre("two-anchors", "unnamed-piece"));
  // The seam beside the left-out region is a hem: only the other has mates.
  ASSERT_EQ(result->mates.size(), 1U);
  EXPECT_EQ(result->pieces[0].wires[result->mates[0].wireA].curve, "b");
  // A place on an edge is rounded to 10 mm / 2^26.
  EXPECT_NEAR(result->includedArea, 40 * (120 - 41), 1e-5);
  const double included = areaOf(*result->pieces[0].mesh) + areaOf(*result->pieces[2].mesh);
  EXPECT_NEAR(result->includedArea, included, 1e-12 * included);
}

TEST(Cut, FindsAnAnchorByItsName) {
  const Mesh mesh = test::grid(12, 4);
  ReferenceModel model = makeReferenceModel("strip", mesh);
  model.landmarks["tip"] = {VertexId(11)};
  PieceRecord named;
  named.id = "right";
  named.anchor = AtLandmark{"tip"};
  Design design;
  design.pieces = {named};
  const auto section = planeSections(mesh, Eigen::Vector3d::UnitX(), 83);
  const std::vector curves{drawn("s", CurveKind::Seam, section.at(0))};
  const auto cutWith = [&] {
    return cut({std::make_shared<Design>(design), std::make_shared<ReferenceModel>(model)}, curves);
  };
  const auto result = cutWith();
  ASSERT_TRUE(result) << result.error();
  EXPECT_EQ(result->pieces[0].id, "right");
  EXPECT_NEAR(areaOf(*result->pieces[0].mesh), 40 * 37, 1e-5);

  design.pieces[0].anchor = AtLandmark{"nowhere"};
  const auto refused = cutWith();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::NameNotFound);
  EXPECT_NE(refused.error().message.find("\"right\""), std::string::npos);
}

TEST(Cut, LeavesAPieceBitwiseTheSameWhenAnotherIsEdited) {
  const Mesh mesh = test::icosphere(100, 4);
  const auto seam = planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 3.0);
  const auto elsewhere = planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 50.0);
  const auto before = cut(documentOf(mesh), std::vector{drawn("s", CurveKind::Seam, seam.at(0))});
  const auto after = cut(documentOf(mesh), std::vector{drawn("t", CurveKind::Seam, elsewhere.at(0)),
                                                       drawn("s", CurveKind::Seam, seam.at(0))});
  ASSERT_TRUE(before && after);
  ASSERT_EQ(before->pieces.size(), 2U);
  ASSERT_EQ(after->pieces.size(), 3U);
  std::size_t same = 0;
  for (const Piece& was : before->pieces) {
    for (const Piece& is : after->pieces) same += contentHash(was) == contentHash(is) ? 1 : 0;
  }
  EXPECT_EQ(same, 1U);
}

TEST(Cut, DoesNotDependOnTheNumberOfThreads) {
  const Mesh mesh = test::icosphere(100, 3);
  std::mt19937_64 random(3);
  const Document document = documentOf(mesh);
  for (int trial = 0; trial < 5; ++trial) {
    const auto curves = test::randomCurves(mesh, 8, random);
    const auto cutWith = [&](std::size_t threads) {
      const ThreadLimit limit(threads);
      return *cut(document, curves);
    };
    const CutResult one = cutWith(1);
    const CutResult many = cutWith(2);
    ASSERT_EQ(one.pieces.size(), many.pieces.size());
    for (std::size_t p = 0; p < one.pieces.size(); ++p) {
      EXPECT_EQ(contentHash(one.pieces[p]), contentHash(many.pieces[p]));
      EXPECT_EQ(one.pieces[p].onModel, many.pieces[p].onModel);
    }
    EXPECT_EQ(one.includedArea, many.includedArea);
    EXPECT_EQ(one.findings, many.findings);
  }
}

TEST(Cut, StopsWhenCancelled) {
  struct : Progress {
    void step(std::string_view name) override { EXPECT_EQ(name, "cut"); }
    [[nodiscard]] bool isCancelled() const override { return true; }
  } progress;
  const auto result = cut(documentOf(test::grid(2, 2)), {}, &progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
}

// A seam along the model's border does not sew it to anything.
TEST(Cut, LeavesTheModelsBorderAHem) {
  const Mesh mesh = test::grid(6, 4);
  std::vector<VertexId> line;
  for (unsigned i = 0; i <= 6; ++i) line.emplace_back(i);
  const auto result =
      cut(documentOf(mesh), std::vector{drawn("s", CurveKind::Seam, test::edgePath(mesh, line))});
  ASSERT_TRUE(result) << result.error();
  expectSoundWires(*result);
  ASSERT_EQ(result->pieces.size(), 1U);
  ASSERT_EQ(result->pieces[0].wires.size(), 1U);
  EXPECT_EQ(result->pieces[0].wires[0].kind, WireKind::Border);
  EXPECT_EQ(result->pieces[0].wires[0].curve, "border");
  EXPECT_TRUE(result->mates.empty());
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece", "hidden-curve"));
}

TEST(Cut, GivesAnOpeningNoMates) {
  const Mesh mesh = test::grid(6, 4);
  const auto zip = planeSections(mesh, Eigen::Vector3d::UnitX(), 33);
  const auto result = cut(documentOf(mesh), std::vector{drawn("z", CurveKind::Opening, zip.at(0))});
  ASSERT_TRUE(result) << result.error();
  expectSoundWires(*result);
  EXPECT_EQ(result->pieces.size(), 2U);
  EXPECT_TRUE(result->mates.empty());
}

TEST(Cut, ContentHashSeesTargets) {
  const Mesh mesh = test::grid(3, 3);
  const auto result = cut(documentOf(mesh), {});
  ASSERT_TRUE(result);
  Piece piece = result->pieces[0];
  const ContentHash before = contentHash(piece);
  piece.id = piece.name = "renamed";
  EXPECT_EQ(contentHash(piece), before);
  piece.wires[0].targetLength[0] *= 1 + 1e-15;
  EXPECT_NE(contentHash(piece), before);
}

TEST(Cut, SaysWhichCurveOthersHide) {
  const Mesh mesh = test::grid(4, 4);
  const auto section = planeSections(mesh, Eigen::Vector3d::UnitX(), 17);
  const auto result =
      cut(documentOf(mesh), std::vector{drawn("s", CurveKind::Seam, section.at(0)),
                                        drawn("f", CurveKind::Feature, section.at(0))});
  ASSERT_TRUE(result) << result.error();
  EXPECT_THAT(codes(*result), ElementsAre("unnamed-piece", "hidden-curve"));
  EXPECT_EQ(result->findings.back().where.at(0), Element::curve("f"));
}

TEST(Cut, SurvivesRandomDesigns) {
  const std::array meshes{test::icosphere(50, 2), test::grid(6, 5), test::cube(60, 1),
                          test::torus(60, 20, 16, 9), test::cylinder(30, 80, 12, 5)};
  constexpr std::uint64_t kSeed = 4711;
  std::cout << "seed " << kSeed << "\n";
  std::mt19937_64 random(kSeed);
  std::size_t trialsWithPieces = 0;
  std::size_t mates = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Mesh& mesh = meshes[static_cast<std::size_t>(trial) % meshes.size()];
    const auto curves = test::randomCurves(mesh, 1 + trial % 9, random);
    const auto result = cut(documentOf(mesh), curves);
    ASSERT_TRUE(result) << result.error() << " in trial " << trial;
    expectSoundWires(*result);
    expectGluesBack(mesh, *result);
    if (testing::Test::HasFailure()) FAIL() << "in trial " << trial;
    trialsWithPieces += result->pieces.size() > 1 ? 1 : 0;
    mates += result->mates.size();
  }
  EXPECT_GT(trialsWithPieces, 400U);
  std::cout << trialsWithPieces << " trials gave several pieces, " << mates
            << " seams with mates\n";
}

}  // namespace
}  // namespace toile
