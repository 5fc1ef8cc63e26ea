// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "finish/polygon.h"
#include "layout/clearance.h"
#include "support/sample_designs.h"

namespace toile::test {
namespace {

// Where a corner's allowance lies along the sew line, a slit of no width used to be left in the cut
// line of three of the vest's pieces, which a knife would have followed.
TEST(CutLine, OfTheExamplesDoesNotCrossItself) {
  for (const char* name : {"torso-vest.toile", "bent-sleeve.toile", "wetsuit-short.toile"}) {
    const Result<Document> document = openDocument(exampleDesign(name));
    ASSERT_TRUE(document) << document.error();
    const Result<Pattern> pattern = makePattern(*document);
    ASSERT_TRUE(pattern) << pattern.error();
    for (const PatternPiece& piece : pattern->pieces) {
      for (const Outline& loop : piece.cutLines) {
        const auto crossing = findSelfCrossing(positions(loop));
        EXPECT_FALSE(crossing) << name << ", " << piece.name << " at " << crossing->transpose();
      }
    }
  }
}

}  // namespace
}  // namespace toile::test
