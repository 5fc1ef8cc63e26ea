// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "finish/polygon.h"
#include "support/hand_made_pattern.h"
#include "support/meshes.h"
#include "support/result_printing.h"

namespace toile {
namespace {

const PatternPiece& pieceOf(const Pattern& pattern, const std::string& id) {
  return *std::find_if(pattern.pieces.begin(), pattern.pieces.end(),
                       [&](const PatternPiece& piece) { return piece.id == id; });
}

/// The pattern finished again with other settings.
std::vector<PatternPiece> finishedWith(const Pattern& pattern,
                                       const std::function<void(Design&)>& change) {
  auto design = std::make_shared<Design>(*pattern.document.design);
  change(*design);
  Document document = pattern.document;
  document.design = design;
  const auto pieces = finish(document, pattern.curves, pattern.cut, pattern.flats);
  EXPECT_TRUE(pieces) << pieces.error();
  return pieces ? *pieces : std::vector<PatternPiece>();
}

TEST(Finish, SewLineIsTheFlatBoundaryWithItsCorners) {
  const Pattern pattern = test::makeTwoPiecePattern();
  ASSERT_EQ(pattern.pieces.size(), 2u);
  const PatternPiece& ell = pattern.pieces[0];
  ASSERT_EQ(ell.sewLines.size(), 1u);
  EXPECT_DOUBLE_EQ(signedArea(positions(ell.sewLines[0])), 300 * 200 + 120 * 200);
  int corners = 0;
  for (const OutlinePoint& p : ell.sewLines[0]) corners += p.corner ? 1 : 0;
  EXPECT_EQ(corners, 6);
  EXPECT_TRUE(ell.sewLines[0].front().corner);
  std::size_t edges = 0;
  double length = 0;
  for (const OutlineRun& run : ell.runs) {
    edges += run.edgeCount;
    length += run.length;
  }
  EXPECT_EQ(edges, ell.sewLines[0].size());
  EXPECT_DOUBLE_EQ(length, 1400);
  EXPECT_TRUE(ell.findings.empty());
}

// The seam "side" is drawn upwards: the ell lies on its left, the panel on its right.
TEST(Finish, AllowanceIsThatOfTheSideOfTheCurve) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const auto cutArea = [&](const char* id) {
    return signedArea(positions(pieceOf(pattern, id).cutLines.at(0)));
  };
  // Area + perimeter * width + a square per convex corner less one for the concave one.
  EXPECT_NEAR(cutArea("ell"), 84000 + 1400 * 10 + 4 * 100, 0.1);
  EXPECT_NEAR(cutArea("panel"), (200 + 10 + 6) * (200 + 20), 0.1);
  for (const OutlineRun& run : pieceOf(pattern, "panel").runs)
    EXPECT_EQ(run.allowance, run.curve == "side" ? 6 : 10);
}

TEST(Finish, MatesHaveTheSameSeamNumberAndLength) {
  const Pattern pattern = test::makeTwoPiecePattern();
  std::map<int, std::map<std::string, double>> lengths;
  for (const PatternPiece& piece : pattern.pieces)
    for (const OutlineRun& run : piece.runs) {
      EXPECT_EQ(run.seam != 0, run.kind == WireKind::Seam);
      if (run.seam == 0) continue;
      lengths[run.seam][piece.id] += run.length;
      EXPECT_EQ(run.mate, piece.id == "ell" ? "panel" : "ell");
    }
  ASSERT_EQ(lengths.size(), 1u);
  EXPECT_EQ(lengths[1]["ell"], 200);
  EXPECT_EQ(lengths[1]["panel"], 200);
}

/// Notches by number: piece -> height on the seam. The flat pieces lie as on the model.
std::map<int, std::map<std::string, double>> sideNotches(const std::vector<PatternPiece>& pieces) {
  std::map<int, std::map<std::string, double>> heights;
  for (const PatternPiece& piece : pieces)
    for (const Notch& notch : piece.notches)
      if (notch.seam == "side") heights[notch.number][piece.id] = notch.onSewLine.y();
  return heights;
}

TEST(Finish, NotchesArePairedAtEqualSewnLengths) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const auto few = sideNotches(pattern.pieces);
  ASSERT_EQ(few.size(), 1u);  // the waist line's
  EXPECT_NEAR(few.begin()->second.at("ell"), 100, 1e-9);
  EXPECT_NEAR(few.begin()->second.at("panel"), 100, 1e-9);

  const auto pieces =
      finishedWith(pattern, [](Design& d) { d.finish.notchSpacing = Length::mm(50); });
  const auto more = sideNotches(pieces);
  ASSERT_EQ(more.size(), 3u);
  std::vector<double> heights;
  for (const auto& [number, byPiece] : more) {
    EXPECT_GT(number, 0);
    ASSERT_EQ(byPiece.size(), 2u);
    EXPECT_NEAR(byPiece.at("ell"), byPiece.at("panel"), 1e-9);
    heights.push_back(byPiece.at("ell"));
  }
  // Turned upside down, the seam must not match: more than 12 mm off.
  std::sort(heights.begin(), heights.end());
  EXPECT_GT(std::abs(heights.front() - (200 - heights.back())), 12);
}

TEST(Finish, NotchesStandOnVerticesOfTheCutLine) {
  const Pattern pattern = test::makeTwoPiecePattern();
  for (const PatternPiece& piece : pattern.pieces) {
    const std::vector<Points2> cut = positions(piece.cutLines);
    EXPECT_FALSE(piece.notches.empty());
    for (const Notch& notch : piece.notches) {
      EXPECT_NE(std::find(cut[0].begin(), cut[0].end(), notch.position), cut[0].end());
      const double allowance = piece.id == "panel" && notch.seam == "side" ? 6 : 10;
      EXPECT_NEAR((notch.position - notch.onSewLine).norm(), allowance, 1e-3);
      EXPECT_NEAR(notch.direction.norm(), 1, 1e-12);
      EXPECT_TRUE(isInside(cut, notch.position + notch.depth * notch.direction));
      EXPECT_FALSE(isInside(cut, notch.position - notch.direction));
      EXPECT_LE(notch.depth, 0.5 * allowance);
    }
  }
}

TEST(Finish, WithoutAllowanceNotchesStandOnTheSewLine) {
  const Pattern pattern = test::makeTwoPiecePattern(0);
  for (const PatternPiece& piece : pattern.pieces) {
    EXPECT_NEAR(signedArea(positions(piece.cutLines[0])), signedArea(positions(piece.sewLines[0])),
                1e-9);
    for (const Notch& notch : piece.notches)
      EXPECT_LT((notch.position - notch.onSewLine).norm(), 1e-9);
  }
}

TEST(Finish, FeaturesAreDrawnAndTheirEndsNotched) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const PatternPiece& ell = pieceOf(pattern, "ell");
  ASSERT_EQ(ell.internalLines.size(), 1u);
  EXPECT_EQ(ell.internalLines[0].name, "Waist line");
  EXPECT_EQ(ell.internalLines[0].points.size(), 300 / test::kLatticeMm + 1);
  const auto atBorder = std::find_if(ell.notches.begin(), ell.notches.end(), [](const Notch& n) {
    return n.onSewLine == Eigen::Vector2d(0, 100);
  });
  ASSERT_NE(atBorder, ell.notches.end());
  EXPECT_EQ(atBorder->number, 0);  // nothing is sewn on there
}

TEST(Finish, GrainAndLabelLieInsideThePiece) {
  const Pattern pattern = test::makeTwoPiecePattern();
  for (const PatternPiece& piece : pattern.pieces) {
    const std::vector<Points2> sew = positions(piece.sewLines);
    const double height = boxOf(sew[0]).size().y();
    EXPECT_TRUE(isInside(sew, piece.labelPosition));
    EXPECT_EQ(piece.grain[0].x(), piece.grain[1].x());
    EXPECT_GE(piece.grain[1].y() - piece.grain[0].y(), 0.6 * height);
    for (int i = 0; i <= 20; ++i)
      EXPECT_TRUE(isInside(sew, piece.grain[0] + i / 20.0 * (piece.grain[1] - piece.grain[0])));
  }
  const PatternPiece& ell = pieceOf(pattern, "ell");
  EXPECT_GT(EdgeGrid(positions(ell.sewLines)).nearest(ell.labelPosition).distance, 99);
}

TEST(Finish, LabelSaysWhatTheCuttingRoomNeeds) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const std::vector<std::string> expected{"ell", "Piece 1 of 2, cut 2", "Fabric: Neoprene 3 mm",
                                          "two pieces, size M", "With 10 mm seam allowance"};
  EXPECT_EQ(pieceOf(pattern, "ell").label, expected);
  EXPECT_EQ(pieceOf(pattern, "panel").label.back(), "With 6 to 10 mm seam allowance");
}

TEST(Finish, MarksAreDrawnWhereTheyCrossThePiece) {
  Pattern pattern = test::makeTwoPiecePattern();
  auto design = std::make_shared<Design>(*pattern.document.design);
  StylingCurve mark;
  mark.id = mark.name = "logo";
  mark.kind = CurveKind::Mark;
  design->curves.push_back(mark);
  pattern.document.design = design;
  // From the middle of a face of the ell across the seam into the panel, at z = 45.
  const Mesh& model = *pattern.document.model->mesh;
  const auto at = [&](double x, double z) {
    for (std::size_t f = 0; f < model.faceCount(); ++f) {
      const Triangle& t = model.vertices(FaceId(f));
      const auto weight = [&](std::size_t k) {
        const Eigen::Vector3d& a = model.position(t[(k + 1) % 3]);
        const Eigen::Vector3d& b = model.position(t[(k + 2) % 3]);
        const Eigen::Vector3d& c = model.position(t[k]);
        const auto side = [&](double px, double pz) {
          return (b.x() - a.x()) * (pz - a.z()) - (b.z() - a.z()) * (px - a.x());
        };
        return side(x, z) / side(c.x(), c.z());
      };
      const Eigen::Vector3d w(weight(0), weight(1), weight(2));
      if (w.minCoeff() >= -1e-12) return std::pair(FaceId(f), w);
    }
    return std::pair(FaceId(), Eigen::Vector3d(0, 0, 0));
  };
  // Straight from x = 283 to x = 317, split where it leaves each face.
  PlacedCurve placed{"logo", CurveKind::Mark, {}, {}};
  const std::vector<double> xs{283, 285, 300, 305, 317};
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const auto [face, w] = at(xs[i], 45);
    placed.path.points.push_back(makeSurfacePoint(model, face, w));
    if (i > 0) placed.path.faceOfSegment.push_back(at(0.5 * (xs[i - 1] + xs[i]), 45).first);
  }
  ASSERT_TRUE(isValid(model, placed.path));
  pattern.curves.push_back(placed);
  // The pieces' faces lie on the model's faces of the same place.
  for (Piece& piece : pattern.cut.pieces) {
    piece.sourceFace = FaceData<FaceId>(piece.mesh->faceCount());
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const VertexId v : piece.mesh->vertices(FaceId(f)))
        middle += piece.mesh->position(v) / 3;
      piece.sourceFace[FaceId(f)] = at(middle.x(), middle.z()).first;
    }
  }
  const auto pieces = finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
  ASSERT_TRUE(pieces) << pieces.error();
  const InternalLine& inEll = (*pieces)[0].internalLines.back();
  const InternalLine& inPanel = (*pieces)[1].internalLines.back();
  ASSERT_EQ(inEll.kind, CurveKind::Mark);
  ASSERT_EQ(inPanel.kind, CurveKind::Mark);
  EXPECT_LT((inEll.points.front() - Eigen::Vector2d(283, 45)).norm(), 1e-9);
  EXPECT_LT((inEll.points.back() - Eigen::Vector2d(300, 45)).norm(), 1e-6);
  EXPECT_LT((inPanel.points.front() - Eigen::Vector2d(300, 45)).norm(), 1e-6);
  EXPECT_LT((inPanel.points.back() - Eigen::Vector2d(317, 45)).norm(), 1e-9);
}

// A square of 200 mm with a dart of 60 mm in the middle of its lower edge, 24 mm wide at the mouth.
TEST(Finish, DartsAreNotchedAtTheirMouth) {
  const Mesh square = test::grid(10, 10, 20);
  PolygonSoup::Chain slit;
  slit.group = "wire_dart_d";
  for (const std::uint32_t row : {0u, 1u, 2u, 3u}) slit.vertices.push_back(row * 11 + 5);
  const Result<Piece> made = makePiece("darted", square, {slit});
  ASSERT_TRUE(made) << made.error();
  CutResult cut;
  cut.pieces.push_back(*made);
  Piece& piece = cut.pieces.back();
  piece.id = "darted";
  FlatPiece flat;
  flat.position = VertexData<Eigen::Vector2d>(piece.mesh->vertexCount(), Eigen::Vector2d::Zero());
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
    const Triangle& corners = piece.mesh->vertices(FaceId(f));
    double middle = 0;
    for (const VertexId v : corners) middle += piece.mesh->position(v).x() / 3;
    for (const VertexId v : corners) {
      const Eigen::Vector3d& p = piece.mesh->position(v);
      const double open = std::max(0.0, 12 * (1 - p.y() / 60));
      flat.position[v] = {p.x() + (middle > 100 ? open : -open), p.y()};
    }
  }
  std::vector<std::uint32_t> legs;
  for (std::uint32_t w = 0; w < piece.wires.size(); ++w)
    if (piece.wires[w].kind == WireKind::Dart) legs.push_back(w);
  ASSERT_EQ(legs.size(), 2u);
  cut.mates.push_back({0, legs[0], 0, legs[1]});
  Document document;
  document.design = std::make_shared<const Design>();
  const auto pieces = finish(document, {}, cut, {std::make_shared<const FlatPiece>(flat)});
  ASSERT_TRUE(pieces) << pieces.error();
  const PatternPiece& darted = pieces->front();
  EXPECT_TRUE(darted.findings.empty());
  // The dart is folded: its legs go on to the cut line, where they are notched with one number, and
  // a drill hole stands 12 mm inside the tip.
  ASSERT_EQ(darted.notches.size(), 2u);
  for (const Notch& notch : darted.notches) {
    EXPECT_EQ(notch.number, 1);
    EXPECT_EQ(notch.seam, "border");
    EXPECT_NEAR(std::abs(notch.onSewLine.x() - 100), 12, 1e-9);
    EXPECT_NEAR(std::abs(notch.position.x() - 100), 14, 1e-3);
    EXPECT_NEAR(notch.position.y(), -10, 1e-3);
    const Eigen::Vector2d leg = Eigen::Vector2d(100, 60) - notch.onSewLine;
    EXPECT_NEAR(notch.direction.dot(leg.normalized()), 1, 1e-9);
  }
  ASSERT_EQ(darted.drillHoles.size(), 1u);
  EXPECT_NEAR((darted.drillHoles[0] - Eigen::Vector2d(100, 48)).norm(), 0, 1e-6);
  EXPECT_TRUE(isInside(positions(darted.cutLines), {100, 5}));
  // Without allowance it is cut out.
  Design design;
  design.finish.allowance = Length::mm(0);
  document.design = std::make_shared<const Design>(design);
  const auto open = finish(document, {}, cut, {std::make_shared<const FlatPiece>(flat)});
  ASSERT_TRUE(open) << open.error();
  EXPECT_FALSE(isInside(positions(open->front().cutLines), {100, 5}));
  EXPECT_TRUE(open->front().drillHoles.empty());
}

TEST(Finish, SymmetricPieceBecomesItsHalfOnTheFold) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const std::vector<PatternPiece> pieces = finishedWith(pattern, [](Design& design) {
    for (StylingCurve& curve : design.curves) curve.right.allowance.reset();
  });
  ASSERT_EQ(pieces.size(), 2u);
  PatternPiece half = pieces[1];
  ASSERT_TRUE(foldInHalf(half, pattern.cut.pieces[1], *pattern.flats[1]));
  // The panel is 300..500 x 0..200; the wearer's left is at +x.
  EXPECT_NEAR(signedArea(positions(half.sewLines[0])), 100 * 200, 1e-6);
  EXPECT_NEAR(signedArea(positions(half.cutLines[0])), 110 * 220, 0.1);
  for (const OutlinePoint& p : half.cutLines[0]) EXPECT_GE(p.position.x(), 400 - 1e-9);
  // No allowance and no notch on the fold, which runs with the piece on its left.
  ASSERT_TRUE(half.fold);
  EXPECT_NEAR(((*half.fold)[0] - Eigen::Vector2d(400, 210)).norm(), 0, 1e-9);
  EXPECT_NEAR(((*half.fold)[1] - Eigen::Vector2d(400, -10)).norm(), 0, 1e-9);
  for (const Notch& notch : half.notches) EXPECT_GT(notch.position.x(), 401);
  EXPECT_EQ(half.runs.back().curve, "fold");
  EXPECT_EQ(half.runs.back().allowance, 0);
  EXPECT_NEAR(half.runs.back().length, 200, 1e-9);
  for (const OutlineRun& run : half.runs) EXPECT_NE(run.curve, "side") << "on the half that went";
  ASSERT_EQ(half.internalLines.size(), 1u);
  for (const Eigen::Vector2d& p : half.internalLines[0].points) EXPECT_GE(p.x(), 400 - 1e-9);
  EXPECT_EQ(half.label[1], "Cut on fold");
  for (const Eigen::Vector2d& p : half.grain) EXPECT_TRUE(isInside(positions(half.sewLines), p));
  // What is not symmetric stays whole.
  PatternPiece ell = pieces[0];
  EXPECT_FALSE(foldInHalf(ell, pattern.cut.pieces[0], *pattern.flats[0]));
  EXPECT_FALSE(ell.fold);
  EXPECT_EQ(positions(ell.cutLines), positions(pieces[0].cutLines));
}

TEST(Finish, RefusesAPieceThatLiesWrongSideUp) {
  Pattern pattern = test::makeTwoPiecePattern();
  FlatPiece flat = *pattern.flats[0];
  for (Eigen::Vector2d& p : flat.position.values()) p.x() = -p.x();
  pattern.flats[0] = std::make_shared<const FlatPiece>(flat);
  const auto pieces = finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
  ASSERT_FALSE(pieces);
  EXPECT_EQ(pieces.error().code, ErrorCode::InvalidArgument);
  EXPECT_EQ(pieces.error().where, std::vector<Element>{Element::piece("ell")});
}

TEST(Finish, LeavesOutPiecesWithoutFlat) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.flats[0] = nullptr;
  const auto pieces = finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
  ASSERT_TRUE(pieces) << pieces.error();
  ASSERT_EQ(pieces->size(), 1u);
  EXPECT_EQ((*pieces)[0].id, "panel");
  EXPECT_EQ((*pieces)[0].of, 1);
}

}  // namespace
}  // namespace toile
