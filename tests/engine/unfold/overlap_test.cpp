// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/generated_pieces.h"
#include "support/patches.h"
#include "support/result_printing.h"

namespace toile {
namespace {

/// A nearly level strip of more than one turn, which rises by 5 mm and moves outwards by 10: in the
/// plane its end lies over its beginning.
Mesh windingStrip(double turns, int segments, int rows) {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= segments; ++i) {
      const double a = 2 * std::numbers::pi * turns * i / segments;
      const double r = 80 + 40.0 * j / rows + 10.0 * i / segments;
      positions.emplace_back(r * std::cos(a), r * std::sin(a), 5.0 * i / segments);
    }
  }
  const auto at = [segments](int i, int j) {
    return VertexId(static_cast<std::size_t>(j * (segments + 1) + i));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < segments; ++i) {
      // Outside up: the radius grows with j, so x runs against the angle.
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  return *makeMesh(std::move(positions), std::move(triangles));
}

TEST(Overlaps, OfAWindingStripAreWhereItPassesTwice) {
  // 1.1 turns: a tenth of the ring is covered twice.
  const Piece piece = test::patchOf(windingStrip(1.1, 88, 6));
  const Result<FlatPiece> flat = unfold(piece, {.keepApart = false});
  ASSERT_TRUE(flat) << flat.error();
  ASSERT_GT(flat->check.crossings, 0U);
  ASSERT_EQ(flat->overlaps.size(), 1U);
  const Overlap& overlap = flat->overlaps[0];
  // There the beginning reaches from 80.5 to 120.5 mm and the end from 89.5 mm on.
  const double known = 0.1 * std::numbers::pi * (120.5 * 120.5 - 89.5 * 89.5);
  EXPECT_NEAR(overlap.area, known, 0.1 * known);
  // One layer is the beginning of the strip, the other its end: on the surface, by its faces.
  for (const std::vector<FaceId>& layer : overlap.layers) {
    double first = 1, last = 0;
    for (const FaceId f : layer) {
      const double along = piece.mesh->position(piece.mesh->vertices(f)[0]).z() / 5;
      first = std::min(first, along);
      last = std::max(last, along);
    }
    EXPECT_LT(last - first, 0.15);
    EXPECT_TRUE(last < 0.2 || first > 0.8);
  }
  const auto& found = flat->findings;
  const auto crossings = std::find_if(found.begin(), found.end(),
                                      [](const Finding& f) { return f.code == "crossings"; });
  ASSERT_NE(crossings, found.end());
  EXPECT_THAT(crossings->message, testing::HasSubstr("1 part is covered twice"));
  EXPECT_THAT(crossings->where,
              testing::Contains(Element::face(overlap.layers[0][overlap.layers[0].size() / 2])));
}

TEST(Overlaps, AreThereExactlyWhereWiresCross) {
  for (const test::GeneratedPiece& each : test::generatedPieces()) {
    SCOPED_TRACE(each.name);
    const Result<FlatPiece> flat = unfold(each.piece, {.keepApart = false});
    if (!flat) continue;
    EXPECT_EQ(!flat->overlaps.empty(), flat->check.crossings > 0);
    double twice = 0;
    for (const Overlap& overlap : flat->overlaps) twice += overlap.area;
    if (each.overlapsItself) {
      EXPECT_GT(twice, 1.0);
    }
  }
}

// 1.5 turns: the end of the strip passes the beginning at vertices of it, so that no two edges
// cross inside.
TEST(Overlaps, AreNoticedWhereTheBoundaryPassesThroughItsOwnVertices) {
  const Result<FlatPiece> flat =
      unfold(test::patchOf(windingStrip(1.5, 120, 6)), {.keepApart = false});
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_EQ(flat->check.crossings, 2U);
  EXPECT_EQ(flat->overlaps.size(), 1U);
}

// What would lie on itself is kept apart, with all lengths; the strip has to be strained for it.
TEST(KeptApart, IsWhatWouldLieOnItself) {
  for (const double turns : {1.01, 1.1, 1.5}) {
    SCOPED_TRACE(turns);
    const Piece piece = test::patchOf(windingStrip(turns, static_cast<int>(80 * turns), 6));
    const Result<FlatPiece> over = unfold(piece, {.keepApart = false}), apart = unfold(piece);
    ASSERT_TRUE(over && apart);
    ASSERT_GT(over->check.crossings, 0U);
    EXPECT_TRUE(apart->check.passes());
    EXPECT_LE(apart->check.maxLengthError, 1e-12);
    EXPECT_GT(apart->meanAreaError, over->meanAreaError);
    EXPECT_LT(apart->meanAreaError, 0.06);
    EXPECT_FALSE(apart->overlaps.empty()) << "where it would have";
    EXPECT_EQ(apart->findings.front().code, "kept-apart");
    EXPECT_THAT(apart->findings.front().where, testing::SizeIs(2 * apart->overlaps.size()));
  }
}

TEST(KeptApart, ChangesNothingElse) {
  for (const test::GeneratedPiece& each : test::generatedPieces()) {
    SCOPED_TRACE(each.name);
    const Result<FlatPiece> over = unfold(each.piece, {.keepApart = false});
    const Result<FlatPiece> apart = unfold(each.piece);
    ASSERT_EQ(over.hasValue(), apart.hasValue());
    if (!over) continue;
    EXPECT_TRUE(apart->check.passes());
    if (over->check.crossings > 0) continue;
    EXPECT_EQ(apart->position.values(), over->position.values());
  }
}

}  // namespace
}  // namespace toile
