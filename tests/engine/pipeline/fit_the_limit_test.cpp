// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "support/sample_designs.h"
#include "toile/io/report.h"
#include "toile/pipeline.h"

// What makePattern() does with pieces that lie flat badly: darts, developable processing.
namespace toile::test {
namespace {

double worstError(const Pattern& pattern) {
  double worst = 0;
  for (const auto& flat : pattern.flats) {
    if (flat) worst = std::max(worst, flat->meanAreaError);
  }
  return worst;
}

std::size_t count(const Pattern& pattern, const std::string& code) {
  return static_cast<std::size_t>(std::count_if(pattern.findings.begin(), pattern.findings.end(),
                                                [&](const Finding& f) { return f.code == code; }));
}

TEST(FitTheLimit, LinesComeInPairsOnAVest) {
  const Result<Document> vest = openDocument(exampleDesign("torso-vest.toile"));
  ASSERT_TRUE(vest) << vest.error();
  const Result<Pattern> plain = makePattern(*vest);
  ASSERT_TRUE(plain) << plain.error();
  ASSERT_GT(worstError(*plain), 0.025) << "the vest has pieces that want a dart";
  EXPECT_TRUE(std::all_of(plain->developed.begin(), plain->developed.end(),
                          [](const auto& d) { return d == nullptr; }));

  MakeOptions options;
  options.autoDart = Ratio::percent(2.5);
  const Result<Pattern> darted = makePattern(*vest, options);
  ASSERT_TRUE(darted) << darted.error();
  EXPECT_TRUE(darted->isComplete());
  EXPECT_LE(worstError(*darted), 0.025);
  EXPECT_EQ(darted->pieces.size(), plain->pieces.size()) << "darts are enough";
  EXPECT_GE(count(*darted, "auto-dart"), 1U);
  std::size_t lines = 0, images = 0;
  for (const StylingCurve& curve : darted->document.design->curves) {
    if (!curve.id.starts_with("auto")) continue;
    ++lines;
    if (curve.mirrorOf) ++images;
  }
  EXPECT_GE(images, 1U);
  EXPECT_EQ(lines, 2 * images);
  // No history: with a cache of other work the bytes are the same.
  PatternCache cache;
  ASSERT_TRUE(makePattern(*vest, {}, &cache));
  const Result<Pattern> again = makePattern(*vest, options, &cache);
  ASSERT_TRUE(again) << again.error();
  EXPECT_EQ(writeReportJson(*again), writeReportJson(*darted));
}

TEST(FitTheLimit, DartsAreProposedForWovenClothToo) {
  const Result<Document> vest = openDocument(exampleDesign("torso-vest.toile"));
  ASSERT_TRUE(vest) << vest.error();
  Design design = *vest->design;
  ASSERT_FALSE(design.fabrics.empty());
  design.fabrics.front().weights = ClothWeights{2, 1, 0.5, {}};
  MakeOptions options;
  options.autoDart = Ratio::percent(2);
  const Result<Pattern> plain = makePattern(withDesign(*vest, design));
  const Result<Pattern> darted = makePattern(withDesign(*vest, design), options);
  ASSERT_TRUE(plain && darted);
  ASSERT_GT(worstError(*plain), 0.02);
  EXPECT_GE(count(*darted, "auto-dart"), 1U);
  EXPECT_LE(worstError(*darted), 0.02);
}

TEST(FitTheLimit, APieceIsProcessedAsItsRecordSays) {
  const Document sleeve = sleeveDocument();
  const Result<Pattern> plain = makePattern(sleeve);
  ASSERT_TRUE(plain) << plain.error();
  Design design = *sleeve.design;
  design.pieces.front().develop = DevelopSetting{Ratio::of(0.5), {}, {}, {}};
  const Result<Pattern> processed = makePattern(withDesign(sleeve, design));
  ASSERT_TRUE(processed) << processed.error();
  EXPECT_TRUE(processed->isComplete());
  ASSERT_TRUE(processed->developed[0]);
  EXPECT_FALSE(processed->developed[1]);
  EXPECT_EQ(processed->developed[0]->amount, 0.5);
  EXPECT_LT(processed->flats[0]->meanAreaError, plain->flats[0]->meanAreaError);
  // Seams keep their lengths, features take those of the processed shape, in the cut's edges too.
  const Piece& before = plain->cut.pieces[0];
  const Piece& after = processed->cut.pieces[0];
  EXPECT_EQ(after.mesh->positions(), before.mesh->positions());
  for (std::size_t w = 0; w < after.wires.size(); ++w) {
    const bool isSeam = isBoundary(after.wires[w].kind);
    EXPECT_EQ(after.wires[w].targetLength == before.wires[w].targetLength, isSeam)
        << after.wires[w].curve;
    for (std::size_t e = 0; e < after.wires[w].cutEdges.size(); ++e) {
      EXPECT_EQ(processed->cut.refined->cutEdges[after.wires[w].cutEdges[e].index()].targetLength,
                after.wires[w].targetLength[e]);
    }
  }
  const nlohmann::json report = nlohmann::json::parse(writeReportJson(*processed));
  EXPECT_EQ(report["pieces"][0]["developed"]["amount"], 0.5);
  EXPECT_FALSE(report["pieces"][1].contains("developed"));
}

TEST(FitTheLimit, ProcessingByItselfSparesWhatIsGoodEnough) {
  const Document sleeve = sleeveDocument();
  MakeOptions options;
  options.autoDevelop = Ratio::percent(0.5);
  const Result<Pattern> pattern = makePattern(sleeve, options);
  ASSERT_TRUE(pattern) << pattern.error();
  ASSERT_TRUE(pattern->developed[0]) << "0.8 % is over the limit";
  EXPECT_FALSE(pattern->developed[1]) << "0.3 % is not";
  EXPECT_LE(worstError(*pattern), 0.005);
}

TEST(FitTheLimit, TheLimitCanBeThatOfEachFabric) {
  const Document sleeve = sleeveDocument();
  Design design = *sleeve.design;
  Fabric stiff;
  stiff.id = "stiff";
  stiff.stretchAlong = Ratio::percent(4);
  stiff.stretchAcross = Ratio::percent(0.5);
  Fabric plain;
  plain.id = "plain";
  design.fabrics = {plain, stiff};
  MakeOptions options;
  options.autoDevelop = AreaLimit();
  for (const char* fabric : {"plain", "stiff"}) {
    for (PieceRecord& record : design.pieces) record.fabric = fabric;
    const Result<Pattern> pattern = makePattern(withDesign(sleeve, design), options);
    ASSERT_TRUE(pattern) << pattern.error();
    EXPECT_EQ(pattern->developed[0] != nullptr, design.pieces[0].fabric == "stiff");
    EXPECT_FALSE(pattern->developed[1]) << "0.3 % is not over the limit";
    EXPECT_LE(worstError(*pattern), design.pieces[0].fabric == "stiff" ? 0.005 : 0.01);
  }
}

}  // namespace
}  // namespace toile::test
