// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"

namespace toile {
namespace {

Mesh dome(double height) {
  return test::heightField(16, 14, 10, [height](double x, double y) {
    return 0.7 * y + height * std::exp(-((x - 70) * (x - 70) + (y - 80) * (y - 80)) / 3000);
  });
}

double greatestDistance(const FlatPiece& a, const FlatPiece& b) {
  double greatest = 0;
  for (std::size_t v = 0; v < a.position.size(); ++v) {
    greatest = std::max(greatest, (a.position[VertexId(v)] - b.position[VertexId(v)]).norm());
  }
  return greatest;
}

TEST(UnfoldPreview, ComesNearTheFullAnswerAndNearerWithEachCall) {
  const Piece piece = test::patchOf(dome(30));
  const Result<FlatPiece> full = unfold(piece);
  ASSERT_TRUE(full) << full.error();
  UnfoldPreview preview;
  double last = 5;  // mm, of a piece 160 mm wide
  for (int call = 0; call < 3; ++call) {
    const Result<FlatPiece> quick = preview.update(piece);
    ASSERT_TRUE(quick) << quick.error();
    EXPECT_LT(quick->check.maxLengthError, call == 0 ? 2e-3 : 1e-5);
    EXPECT_EQ(quick->check.flippedFaces, 0U);
    const double distance = greatestDistance(*quick, *full);
    EXPECT_LT(distance, last);
    last = 0.5 * distance;
  }
  EXPECT_LT(last, 0.05);
}

TEST(UnfoldPreview, FollowsAChangeOfShape) {
  UnfoldPreview preview;
  ASSERT_TRUE(preview.update(test::patchOf(dome(30))));
  ASSERT_TRUE(preview.update(test::patchOf(dome(30))));
  const Piece changed = test::patchOf(dome(31));
  const Result<FlatPiece> quick = preview.update(changed);
  const Result<FlatPiece> full = unfold(changed);
  ASSERT_TRUE(quick && full);
  EXPECT_LT(quick->check.maxLengthError, 1e-5);
  EXPECT_LT(greatestDistance(*quick, *full), 0.5);
  EXPECT_NEAR(quick->meanAreaError, full->meanAreaError, 0.05 * full->meanAreaError);
}

TEST(UnfoldPreview, StartsAnewForAnotherPieceAndAfterAnError) {
  UnfoldPreview preview;
  ASSERT_TRUE(preview.update(test::patchOf(dome(30))));
  const Piece other = test::patchOf(test::saddle(8));
  const Result<FlatPiece> after = preview.update(other);
  const Result<FlatPiece> fresh = UnfoldPreview().update(other);
  ASSERT_TRUE(after && fresh);
  EXPECT_EQ(after->position, fresh->position);
  EXPECT_FALSE(preview.update(test::patchOf(test::cylinder(50, 100, 20, 5))));
  EXPECT_TRUE(preview.update(other));
}

}  // namespace
}  // namespace toile
