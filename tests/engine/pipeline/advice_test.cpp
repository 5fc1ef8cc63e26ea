// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/result_printing.h"
#include "support/sample_designs.h"

namespace toile::test {
namespace {

std::size_t worstOf(const Pattern& pattern) {
  std::size_t worst = 0;
  double error = -1;
  for (std::size_t i = 0; i < pattern.flats.size(); ++i) {
    if (!pattern.flats[i] || pattern.flats[i]->meanAreaError <= error) continue;
    error = pattern.flats[i]->meanAreaError;
    worst = i;
  }
  return worst;
}

TEST(Advice, KeepsWhatADartPromises) {
  const Result<Document> vest = openDocument(exampleDesign("torso-vest.toile"));
  ASSERT_TRUE(vest) << vest.error();
  const Result<Pattern> pattern = makePattern(*vest);
  ASSERT_TRUE(pattern) << pattern.error();
  const std::size_t worst = worstOf(*pattern);
  const auto proposals = adviseDarts(*pattern, worst);
  ASSERT_TRUE(proposals) << proposals.error();
  ASSERT_FALSE(proposals->empty());
  const DartProposal& best = proposals->front();
  EXPECT_NEAR(best.errorBefore, pattern->flats[worst]->meanAreaError, 1e-9);
  EXPECT_LT(best.errorAfter, best.errorBefore);

  // The lines lie on the piece, in both of its shapes, as long as the proposal says.
  double length = 0;
  for (const ProposedLine& line : proposedLines(*pattern, worst, best)) {
    ASSERT_EQ(line.onBody.size(), line.inPlane.size());
    for (std::size_t i = 1; i < line.onBody.size(); ++i) {
      length += (line.onBody[i] - line.onBody[i - 1]).norm();
    }
  }
  EXPECT_NEAR(length, best.length, 1e-3 * best.length);

  const Result<Edited> edited = withProposal(*pattern, worst, best);
  ASSERT_TRUE(edited) << edited.error();
  EXPECT_EQ(edited->curves.size(), best.dartCount());
  const Result<Pattern> after = makePattern(edited->document);
  ASSERT_TRUE(after) << after.error();
  EXPECT_TRUE(after->isComplete());
  const std::string& id = pattern->cut.pieces[worst].id;
  for (std::size_t i = 0; i < after->cut.pieces.size(); ++i) {
    if (after->cut.pieces[i].id != id) continue;
    EXPECT_NEAR(after->flats[i]->meanAreaError, best.errorAfter, 0.1 * best.errorBefore);
  }
}

TEST(Advice, RefusesWhatNeedsNoCut) {
  const Result<Document> vest = openDocument(exampleDesign("torso-vest.toile"));
  ASSERT_TRUE(vest) << vest.error();
  const Result<Pattern> pattern = makePattern(*vest);
  ASSERT_TRUE(pattern) << pattern.error();
  const Result<Edited> cut = withShortestCuts(*pattern, worstOf(*pattern));
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::InvalidArgument);
  EXPECT_THAT(cut.error().where, testing::SizeIs(1));
  EXPECT_EQ(adviseDarts(*pattern, 999).error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace toile::test
