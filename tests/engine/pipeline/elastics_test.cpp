// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "support/sample_designs.h"
#include "toile/io/report.h"
#include "toile/pipeline.h"

// Elastic lines of a design: one ratio for all pieces that a line runs through or bounds.
namespace toile::test {
namespace {

StylingCurve& curveOf(Design& design, const std::string& id) {
  return *std::find_if(design.curves.begin(), design.curves.end(),
                       [&](const StylingCurve& c) { return c.id == id; });
}

/// The sleeve with an elastic elbow line around both its pieces, and an elastic seam between them.
Document elasticSleeve(double elbowPercent, double seamPercent) {
  const Document sleeve = sleeveDocument();
  Design design = *sleeve.design;
  curveOf(design, "elbow-line").kind = CurveKind::Elastic;
  curveOf(design, "elbow-line").elasticRange = Ratio::percent(elbowPercent);
  if (seamPercent > 0) {
    curveOf(design, "back-seam").elasticRange = Ratio::percent(seamPercent);
  }
  return withDesign(sleeve, design);
}

void expectMatesAgree(const Pattern& pattern) {
  ASSERT_FALSE(pattern.cut.mates.empty());
  for (const SeamMates& mates : pattern.cut.mates) {
    std::vector<double> a = pattern.cut.pieces[mates.pieceA].wires[mates.wireA].targetLength;
    std::reverse(a.begin(), a.end());
    EXPECT_EQ(a, pattern.cut.pieces[mates.pieceB].wires[mates.wireB].targetLength);
  }
}

TEST(ElasticLines, HaveOneRatioInBothPiecesAndEqualMates) {
  const Result<Pattern> pattern = makePattern(elasticSleeve(4, 2));
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  ASSERT_EQ(pattern->elastics.size(), 2U);
  EXPECT_EQ(pattern->elastics[0].curve, "back-seam");
  EXPECT_EQ(pattern->elastics[1].curve, "elbow-line");
  for (const ElasticLine& line : pattern->elastics) {
    EXPECT_LE(std::abs(line.ratio), line.range);
    EXPECT_GT(std::abs(line.ratio), 1e-4) << "a bent sleeve wants other lengths";
    std::size_t pieces = 0;
    for (std::size_t i = 0; i < pattern->cut.pieces.size(); ++i) {
      const Piece& piece = pattern->cut.pieces[i];
      bool isThere = false;
      for (const Wire& wire : piece.wires) {
        if (wire.curve != line.curve) continue;
        isThere = true;
        for (std::size_t e = 0; e < wire.targetLength.size(); ++e) {
          EXPECT_EQ(wire.targetLength[e], wire.bodyLength[e] * (1 + line.ratio));
          const double flat = (pattern->flats[i]->position[wire.vertices[e + 1]] -
                               pattern->flats[i]->position[wire.vertices[e]])
                                  .norm();
          EXPECT_NEAR(flat, wire.targetLength[e], 1e-9 * std::max(1.0, flat));
        }
      }
      pieces += isThere ? 1 : 0;
    }
    EXPECT_EQ(pieces, 2U);
  }
  expectMatesAgree(*pattern);
  const auto json = nlohmann::json::parse(writeReportJson(*pattern));
  ASSERT_EQ(json["elastics"].size(), 2U);
  EXPECT_EQ(json["elastics"][1]["ratio"].get<double>(), pattern->elastics[1].ratio);
  EXPECT_THAT(writeReportHtml(*pattern), testing::HasSubstr("Elastic lines"));
}

TEST(ElasticLines, StopAtTheEndOfTheirRange) {
  const Result<Pattern> pattern = makePattern(elasticSleeve(0.01, 0));
  ASSERT_TRUE(pattern) << pattern.error();
  ASSERT_EQ(pattern->elastics.size(), 1U);
  EXPECT_EQ(std::abs(pattern->elastics[0].ratio), pattern->elastics[0].range);
  expectMatesAgree(*pattern);
}

// At the ratio that was agreed on, what one piece would gain by another the others would lose.
TEST(ElasticLines, TheSumOfAllPiecesCostsIsLeast) {
  const Document document = elasticSleeve(20, 0);
  const Result<Pattern> pattern = makePattern(document);
  ASSERT_TRUE(pattern) << pattern.error();
  ASSERT_EQ(pattern->elastics.size(), 1U);
  ASSERT_LT(std::abs(pattern->elastics[0].ratio), 0.2);
  double slope = 0, stiffness = 0, single = 0;
  for (Piece piece : pattern->cut.pieces) {
    for (Wire& wire : piece.wires) {
      if (wire.curve == "elbow-line") wire.elasticRange = 1e-12;  // held, but its cost is told
    }
    const Result<FlatPiece> flat = unfold(piece);
    ASSERT_TRUE(flat) << flat.error();
    slope += flat->elastic.gradient[0];
    single = std::max(single, std::abs(flat->elastic.gradient[0]));
    stiffness += flat->elastic.stiffness(0, 0);
  }
  EXPECT_GT(single / stiffness, 1e-4) << "the pieces do not want the same";
  EXPECT_LT(std::abs(slope) / stiffness, 0.1 * single / stiffness);
}

TEST(ElasticLines, OfNoElasticDesignAreNone) {
  const Result<Pattern> pattern = makePattern(sleeveDocument());
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->elastics.empty());
  for (const Piece& piece : pattern->cut.pieces) {
    for (const Wire& wire : piece.wires) EXPECT_EQ(wire.targetLength, wire.bodyLength);
  }
}

}  // namespace
}  // namespace toile::test
