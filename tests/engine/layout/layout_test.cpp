// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "finish/polygon.h"
#include "layout/clearance.h"
#include "support/hand_made_pattern.h"
#include "support/result_printing.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr int kCells = 20;  ///< of the model's sides, each way

/// Two upright squares of 400 mm, one that faces the front at y = 0 and one that faces the back at
/// y = 100, both across x = 0. Their triangles are those of the hand-made pieces' lattice.
Mesh twoSides() {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  for (const bool back : {false, true}) {
    const std::size_t first = positions.size();
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i) {
        const double x = i * test::kLatticeMm - 200;
        positions.emplace_back(back ? -x : x, back ? 100 : 0, j * test::kLatticeMm);
      }
    const auto at = [&](int i, int j) {
      return VertexId(first + static_cast<std::size_t>(j * (kCells + 1) + i));
    };
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  auto mesh = makeMesh(positions, triangles);
  EXPECT_TRUE(mesh) << mesh.error();
  return *mesh;
}

/// Pieces to lay out: parts of the two sides, 10 mm allowance. They may lie on top of each other.
struct Pieces {
  CutResult cut;
  std::vector<std::shared_ptr<const FlatPiece>> flats;
  std::vector<PatternPiece> pattern;
  std::vector<std::uint32_t> index;
  std::vector<HandPlacement> byHand;
  ReferenceModel model = makeReferenceModel("two sides", twoSides());

  /// `turn` turns the flat piece; `fromBehind` puts it on the back of the model.
  void add(const std::function<bool(double, double)>& holds, double turn = 0,
           bool fromBehind = false) {
    const test::HandMadePiece plan{
        "piece" + std::to_string(cut.pieces.size()),
        holds,
        [](double, double) { return std::pair(WireKind::Border, std::string("border")); },
        {},
        {}};
    Piece piece = test::makeHandMadePiece(plan, 400, 400);
    FlatPiece flat = test::flatOf(piece);
    Placement rotation;
    rotation.angle = turn;
    for (Vector2d& p : flat.position.values()) p = rotation.apply(p);
    const auto cell = [](double mm) { return std::lround(mm / test::kLatticeMm); };
    const long firstVertex = fromBehind ? (kCells + 1) * (kCells + 1) : 0;
    for (const Eigen::Vector3d& p : piece.mesh->positions())
      piece.onModel.values().push_back({VertexId(
          static_cast<std::size_t>(firstVertex + cell(p.z()) * (kCells + 1) + cell(p.x())))});
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      const Triangle& t = piece.mesh->vertices(FaceId(f));
      std::array<VertexId, 3> on{};
      for (std::size_t k = 0; k < 3; ++k) on[k] = std::get<VertexId>(piece.onModel[t[k]].at);
      for (const FaceId g : model.mesh->facesAround(on[0]))
        if (model.mesh->vertices(g) == on) piece.sourceFace.values().push_back(g);
    }
    EXPECT_EQ(piece.sourceFace.size(), piece.mesh->faceCount());
    cut.pieces.push_back(piece);
    flats.push_back(std::make_shared<const FlatPiece>(flat));
    index.push_back(static_cast<std::uint32_t>(index.size()));
  }

  Layout arranged() {
    auto design = std::make_shared<Design>();
    Document document;
    document.design = design;
    document.model = std::make_shared<const ReferenceModel>(model);
    auto finished = finish(document, {}, cut, flats);
    EXPECT_TRUE(finished) << finished.error();
    pattern = *std::move(finished);
    auto layout = arrange(model, cut, flats, pattern, index, byHand);
    EXPECT_TRUE(layout) << layout.error();
    return layout ? *std::move(layout) : Layout();
  }

  [[nodiscard]] Points2 cutLine(const Layout& layout, std::size_t piece) const {
    Points2 points = positions(pattern[piece].cutLines.front());
    for (Vector2d& p : points) p = layout.placements[piece].apply(p);
    return points;
  }
};

void expectNoOverlap(const Pieces& pieces, const Layout& layout) {
  for (std::size_t i = 0; i < pieces.pattern.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(distanceBetween(pieces.cutLine(layout, i), pieces.cutLine(layout, j)),
                kLayoutGapMm - 1e-3)
          << i << " and " << j;
}

TEST(Layout, KeepsTheBodysOrderLeftAndRightMirrored) {
  Pieces pieces;
  pieces.add([](double u, double v) { return u < 100 && v < 200; });
  pieces.add([](double u, double v) { return u > 100 && u < 300 && v < 200; });
  pieces.add([](double u, double v) { return u > 300 && v < 200; });
  const Layout layout = pieces.arranged();
  expectNoOverlap(pieces, layout);
  EXPECT_TRUE(layout.findings.empty());
  // The wearer's right (-x) is on the left of the sheet.
  const Box2 left = boxOf(pieces.cutLine(layout, 0));
  const Box2 middle = boxOf(pieces.cutLine(layout, 1));
  const Box2 right = boxOf(pieces.cutLine(layout, 2));
  EXPECT_NEAR(middle.min.x() - left.max.x(), kLayoutGapMm, 2);
  const double axis = 0.5 * (middle.min.x() + middle.max.x());
  EXPECT_NEAR(axis - left.min.x(), right.max.x() - axis, 1e-6);
  EXPECT_NEAR(left.min.y(), right.min.y(), 1e-9);
  EXPECT_NEAR(layout.min.norm(), 0, 1e-9);
  EXPECT_NEAR(layout.max.x(), right.max.x(), 1e-9);
  EXPECT_NEAR(layout.max.y(), 220, 1e-3);
}

// The lowest piece does not come first: the side panels reach below the front ones.
TEST(Layout, KeepsInnerPiecesInside) {
  Pieces pieces;
  pieces.add([](double u, double v) { return u > 100 && u < 200 && v > 20 && v < 300; });
  pieces.add([](double u, double v) { return u > 200 && u < 300 && v > 20 && v < 300; });
  pieces.add([](double u, double v) { return u > 20 && u < 120 && v < 280; });
  pieces.add([](double u, double v) { return u > 280 && u < 380 && v < 280; });
  // A collar on top of the front pieces, over both.
  pieces.add([](double u, double v) { return u > 120 && u < 280 && v > 280 && v < 340; });
  const Layout layout = pieces.arranged();
  expectNoOverlap(pieces, layout);
  std::vector<Box2> boxes;
  for (std::size_t i = 0; i < 5; ++i) boxes.push_back(boxOf(pieces.cutLine(layout, i)));
  EXPECT_LT(boxes[2].max.x(), boxes[0].min.x());
  EXPECT_LT(boxes[0].max.x(), boxes[1].min.x());
  EXPECT_LT(boxes[1].max.x(), boxes[3].min.x());
  EXPECT_GT(boxes[4].min.y(), boxes[0].max.y());
  EXPECT_LT(boxes[1].min.x() - boxes[0].max.x(), 3 * kLayoutGapMm);
  EXPECT_NEAR(boxes[0].min.x() - boxes[2].max.x(), boxes[3].min.x() - boxes[1].max.x(), 1e-6);
}

TEST(Layout, TurnsPiecesAsTheyLieOnTheBody) {
  Pieces pieces;
  pieces.add([](double u, double v) { return u < 200 && (v < 100 || u < 60); }, 0.7);
  const Layout layout = pieces.arranged();
  EXPECT_NEAR(layout.placements[0].angle, -0.7, 1e-6);
  EXPECT_GT(signedArea(pieces.cutLine(layout, 0)), 0);
}

TEST(Layout, PutsThePiecesOfTheBackBesideTheFront) {
  Pieces pieces;
  // Seen from behind, u grows to the wearer's right: the L has its foot there.
  pieces.add([](double u, double v) { return u < 200 && (v < 100 || u < 60); }, 0, true);
  pieces.add([](double u, double v) { return u < 200 && v < 100; });
  const Layout layout = pieces.arranged();
  expectNoOverlap(pieces, layout);
  EXPECT_GT(boxOf(pieces.cutLine(layout, 0)).min.x(), boxOf(pieces.cutLine(layout, 1)).max.x());
  EXPECT_NEAR(layout.placements[0].angle, 0, 1e-6);
}

TEST(Layout, PartsManyPiecesThatLieOnTopOfEachOther) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> at(0, 300);
  std::uniform_real_distribution<double> size(50, 200);
  std::uniform_real_distribution<double> turn(-0.5, 0.5);
  Pieces pieces;
  for (int i = 0; i < 40; ++i) {
    const Vector2d low(at(random), at(random));
    const Vector2d high = low + Vector2d(size(random), size(random));
    const Vector2d knee = 0.5 * (low + high);
    pieces.add(
        [=](double u, double v) {
          return u > low.x() - 10 && u < high.x() && v > low.y() - 10 && v < high.y() &&
                 (u < knee.x() || v < knee.y());
        },
        turn(random), i % 3 == 0);
  }
  const Layout layout = pieces.arranged();
  EXPECT_TRUE(layout.findings.empty());
  expectNoOverlap(pieces, layout);
  const Layout again = pieces.arranged();
  for (std::size_t i = 0; i < 40; ++i)
    EXPECT_EQ(again.placements[i].offset, layout.placements[i].offset);
}

// The article's figure 6: what moves takes along what is still free in its group, so that the order
// on the body stays; the design is symmetric, and so is the sheet.
TEST(Layout, KeepsASymmetricDesignSymmetric) {
  Pieces pieces;
  for (const bool right : {false, true}) {
    const auto mirrored = [right](double u) { return right ? 400 - u : u; };
    pieces.add([=](double u, double v) { return mirrored(u) < 140 && v < 160; });
    pieces.add([=](double u, double v) { return mirrored(u) < 180 && v > 120 && v < 300; });
    pieces.add([=](double u, double v) {
      return mirrored(u) > 60 && mirrored(u) < 200 && v > 260 && (v < 340 || mirrored(u) < 120);
    });
  }
  pieces.add([](double u, double v) { return u > 120 && u < 280 && v > 40 && v < 300; });
  const Layout layout = pieces.arranged();
  expectNoOverlap(pieces, layout);
  EXPECT_TRUE(layout.findings.empty());
  const Box2 middle = boxOf(pieces.cutLine(layout, 6));
  const double axis = 0.5 * (middle.min.x() + middle.max.x());
  for (std::size_t i = 0; i < 3; ++i) {
    const Box2 left = boxOf(pieces.cutLine(layout, i));
    const Box2 right = boxOf(pieces.cutLine(layout, i + 3));
    EXPECT_NEAR(axis - left.min.x(), right.max.x() - axis, 1e-6) << i;
    EXPECT_NEAR(axis - left.max.x(), right.min.x() - axis, 1e-6) << i;
    EXPECT_NEAR(left.min.y(), right.min.y(), 1e-6) << i;
  }
}

TEST(Layout, LeavesPiecesWhereAHandPutThem) {
  const auto first = [](double u, double v) { return u < 100 && v < 200; };
  const auto second = [](double u, double v) { return u > 100 && u < 200 && v < 200; };
  Pieces pieces;
  pieces.add(first);
  pieces.add(second);
  pieces.byHand.push_back({"piece1", {-60, 40}, Angle::degrees(30)});
  const Layout layout = pieces.arranged();
  expectNoOverlap(pieces, layout);
  EXPECT_TRUE(layout.findings.empty());
  EXPECT_NEAR(layout.placements[1].angle, std::numbers::pi / 6, 1e-6);
  // Moved by the hand from its place on the map, which is the model's: its middle is at (150, 100)
  // of the square, so at (-50, 100) of the map.
  const Box2 onMap = [&] {
    Points2 points = positions(pieces.pattern[1].cutLines.front());
    for (Vector2d& p : points) p = layout.onMap[1].apply(p);
    return boxOf(points);
  }();
  EXPECT_NEAR((0.5 * (onMap.min + onMap.max) - Vector2d(-50 - 60, 100 + 40)).norm(), 0, 1e-3);

  // Two hands that put pieces on top of each other are told so.
  pieces.byHand.push_back({"piece0", {}, Angle()});
  pieces.byHand[0] = {"piece1", {-90, 0}, Angle()};
  const Layout crossed = pieces.arranged();
  ASSERT_EQ(crossed.findings.size(), 1U);
  EXPECT_EQ(crossed.findings[0].code, "layout-hand-overlap");
}

TEST(Layout, AHandPutsAPieceWhereItPointsTo) {
  Pieces pieces;
  // The first lies across the axis and is set upright by the layout, the second to its right.
  pieces.add([](double u, double v) { return u > 150 && u < 250 && v < 200; }, 0.1);
  pieces.add([](double u, double v) { return u >= 250 && u < 350 && v < 200; }, 0.4);
  for (const std::size_t index : {0UL, 1UL}) {
    // From the place of the layout, then from where the hand had put it.
    for (const double turn : {0.5, -1.2}) {
      const Layout layout = pieces.arranged();
      Placement wanted = layout.placements[index];
      wanted.angle += turn;
      wanted.offset += Vector2d(310, 470);
      std::erase_if(pieces.byHand,
                    [&](const auto& hand) { return hand.piece == pieces.pattern[index].id; });
      pieces.byHand.push_back(placedByHand(layout, pieces.pattern[index], index, wanted));
      const Layout after = pieces.arranged();
      EXPECT_NEAR(
          std::remainder(after.placements[index].angle - wanted.angle, 2 * std::numbers::pi), 0,
          1e-9);
      // The sheet may begin elsewhere now; its map tells.
      const Vector2d moved = after.mapOrigin[0] - layout.mapOrigin[0];
      EXPECT_NEAR((after.placements[index].offset - wanted.offset - moved).norm(), 0, 1e-6);
    }
  }
}

TEST(Clearance, ShiftOutOfACup) {
  // A cup open to the right, 10 thick; a square of 10 in its middle.
  const Points2 cup{{0, 0}, {100, 0}, {100, 10}, {10, 10}, {10, 50}, {100, 50}, {100, 60}, {0, 60}};
  const Points2 square{{40, 25}, {50, 25}, {50, 35}, {40, 35}};
  std::vector<ShiftRange> right;
  addBlockedShifts(square, cup, 0, right);
  EXPECT_DOUBLE_EQ(leastFreeShift(right), 0);  // it lies free inside
  Points2 inWall = square;
  for (Vector2d& p : inWall) p.y() += 20;  // 45..55, in the upper wall
  std::vector<ShiftRange> blocked;
  addBlockedShifts(inWall, cup, 0, blocked);
  EXPECT_NEAR(leastFreeShift(blocked), 60, 1e-9);
  blocked.clear();
  addBlockedShifts(inWall, cup, 1, blocked);
  EXPECT_NEAR(leastFreeShift(blocked), 15, 1e-9);
  for (Vector2d& p : inWall) p.y() -= 40;  // 5..15, in the lower wall: up into the cup
  blocked.clear();
  addBlockedShifts(inWall, cup, 1, blocked);
  EXPECT_NEAR(leastFreeShift(blocked), 5, 1e-9);
}

TEST(Clearance, GrownHoldsEverythingNear) {
  const Points2 ell{{0, 0}, {100, 0}, {100, 40}, {30, 40}, {30, 90}, {0, 90}};
  const Points2 wide = grown(ell, 5);
  for (int i = 0; i < 64; ++i) {
    const double a = 2 * std::numbers::pi * i / 64;
    for (const Vector2d& p : ell)
      EXPECT_TRUE(isInside({wide}, p + 5 * Vector2d(std::cos(a), std::sin(a))));
  }
  for (const Vector2d& p : wide) EXPECT_LE(EdgeGrid({ell}).nearest(p).distance, 6);
}

TEST(Clearance, FindsWhereAnOutlineCrossesItself) {
  const auto crossing = findSelfCrossing({{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  ASSERT_TRUE(crossing);
  EXPECT_NEAR((*crossing - Vector2d(5, 5)).norm(), 0, 1e-12);
  EXPECT_FALSE(findSelfCrossing({{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  // A corner that touches a side does not cross it.
  EXPECT_FALSE(findSelfCrossing({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}));
}

TEST(Clearance, DistanceSeesCrossingAndHolding) {
  const Points2 a{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Points2 apart{{13, 4}, {20, 4}, {20, 6}};
  const Points2 crossing{{5, -5}, {6, -5}, {6, 15}, {5, 15}};
  const Points2 within{{4, 4}, {5, 4}, {5, 5}};
  EXPECT_NEAR(distanceBetween(a, apart), 3, 1e-12);
  EXPECT_EQ(distanceBetween(a, crossing), 0);
  EXPECT_EQ(distanceBetween(a, within), 0);
  EXPECT_EQ(distanceBetween(within, a), 0);
}

}  // namespace
}  // namespace toile
