// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "support/meshes.h"
#include "support/sample_designs.h"
#include "toile/core/parallel.h"
#include "toile/io/report.h"
#include "toile/pipeline.h"

namespace toile::test {
namespace {

std::string everything(const Pattern& pattern) {
  std::string all = writeReportJson(pattern);
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    if (pattern.flats[i]) all += writePieceObj(pattern.cut.pieces[i], *pattern.flats[i]);
  }
  return all;
}

TEST(MakePattern, MakesBothPiecesOfTheSleeveWithExactLengths) {
  const Result<Pattern> pattern = makePattern(sleeveDocument());
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  ASSERT_EQ(pattern->pieces.size(), 2U);
  EXPECT_EQ(pattern->layout.placements.size(), 2U);
  double area = 0;
  for (std::size_t i = 0; i < pattern->cut.pieces.size(); ++i) {
    const Piece& piece = pattern->cut.pieces[i];
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) area += piece.mesh->area(FaceId(f));
    for (const Wire& wire : piece.wires) {
      for (std::size_t e = 0; e < wire.targetLength.size(); ++e) {
        const double flat = (pattern->flats[i]->position[wire.vertices[e + 1]] -
                             pattern->flats[i]->position[wire.vertices[e]])
                                .norm();
        const double target = wire.targetLength[e];
        EXPECT_LE(std::abs(flat - target), 1e-9 * std::max(target, 1.0)) << wireGroup(wire);
      }
    }
  }
  EXPECT_NEAR(area / pattern->cut.includedArea, 1, 1e-12);
}

TEST(MakePattern, MatesHaveBitwiseEqualTargets) {
  const Result<Pattern> pattern = makePattern(sleeveDocument());
  ASSERT_TRUE(pattern) << pattern.error();
  ASSERT_FALSE(pattern->cut.mates.empty());
  for (const SeamMates& mates : pattern->cut.mates) {
    std::vector<double> a = pattern->cut.pieces[mates.pieceA].wires[mates.wireA].targetLength;
    const std::vector<double>& b =
        pattern->cut.pieces[mates.pieceB].wires[mates.wireB].targetLength;
    std::reverse(a.begin(), a.end());
    EXPECT_EQ(a, b);
  }
}

TEST(MakePattern, SolvesOnlyPiecesThatAnEditTouched) {
  PatternCache cache;
  const Result<Pattern> before = makePattern(tieredSleeve(sleeveDocument(), 500, 150), {}, &cache);
  ASSERT_TRUE(before) << before.error();
  ASSERT_EQ(before->pieces.size(), 6U);
  EXPECT_EQ(cache.solved, 6U);
  EXPECT_EQ(cache.reused, 0U);

  // The lower seam bounds the middle and the lower tier; the two upper pieces do not change.
  const Document edited = tieredSleeve(sleeveDocument(), 500, 160);
  const Result<Pattern> warm = makePattern(edited, {}, &cache);
  ASSERT_TRUE(warm) << warm.error();
  EXPECT_EQ(cache.solved, 10U);
  EXPECT_EQ(cache.reused, 2U);

  // Answers have no history: the same bytes as without a cache.
  const Result<Pattern> cold = makePattern(edited);
  ASSERT_TRUE(cold) << cold.error();
  EXPECT_EQ(everything(*warm), everything(*cold));

  const Result<Pattern> again = makePattern(edited, {}, &cache);
  ASSERT_TRUE(again) << again.error();
  EXPECT_EQ(cache.solved, 10U);
  EXPECT_EQ(cache.reused, 8U);
}

TEST(MakePattern, SolvesAgainWithOtherOptions) {
  PatternCache cache;
  ASSERT_TRUE(makePattern(sleeveDocument(), {}, &cache));
  MakeOptions options;
  options.unfold.areaWeight = 0;
  ASSERT_TRUE(makePattern(sleeveDocument(), options, &cache));
  EXPECT_EQ(cache.solved, 4U);
  EXPECT_EQ(cache.reused, 0U);
}

TEST(MakePattern, IsTheSameForAnyNumberOfThreads) {
  const Document document = tieredSleeve(sleeveDocument(), 500, 150);
  std::set<std::string> answers;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const ThreadLimit limit(threads);
    const Result<Pattern> pattern = makePattern(document);
    ASSERT_TRUE(pattern) << pattern.error();
    answers.insert(everything(*pattern));
  }
  EXPECT_EQ(answers.size(), 1U);
}

Document tube() {
  const Document sleeve = sleeveDocument();
  Design design = *sleeve.design;
  design.curves.clear();
  design.pieces.clear();
  return withDesign(sleeve, design);
}

TEST(MakePattern, NamesATubeAndMakesTheRest) {
  const Result<Pattern> pattern = makePattern(tube());
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_FALSE(pattern->isComplete());
  ASSERT_EQ(pattern->failures.size(), 1U);
  ASSERT_TRUE(pattern->failures[0]);
  EXPECT_EQ(pattern->failures[0]->code, ErrorCode::NotADisk);
  EXPECT_THAT(pattern->failures[0]->message, testing::HasSubstr(pattern->cut.pieces[0].name));
  EXPECT_TRUE(pattern->pieces.empty());
  EXPECT_THAT(pattern->findings,
              testing::Contains(testing::Field(&Finding::code, "tube-without-cut")));
}

TEST(MakePattern, CutsATubeOpenWhenAsked) {
  MakeOptions options;
  options.autoCut = true;
  const Result<Pattern> pattern = makePattern(tube(), options);
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  EXPECT_EQ(pattern->pieces.size(), 1U);
  EXPECT_EQ(pattern->document.design->curves.size(), 1U);
  EXPECT_THAT(pattern->findings, testing::Contains(testing::Field(&Finding::code, "auto-cut")));
  EXPECT_THAT(pattern->findings,
              testing::Not(testing::Contains(testing::Field(&Finding::code, "tube-without-cut"))));
}

// A level strip of 1.3 turns, parted near its beginning: the rest would lie on itself.
TEST(MakePattern, KeepsAPieceApartThatWouldLieOnItselfAndTellsWhereOnTheModel) {
  constexpr int kSegments = 104, kRows = 6;
  std::vector<Eigen::Vector3d> positions;
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kSegments; ++i) {
      const double turn = -2 * std::numbers::pi * 1.3 * i / kSegments;
      const double radius = 80 + 40.0 * j / kRows + 10.0 * i / kSegments;
      positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                             100.0 * i / kSegments);
    }
  }
  const auto at = [&](int column) {
    return NearPosition{positions[static_cast<std::size_t>(column)], {}};
  };
  const auto outer = [&](int column) {
    return NearPosition{positions[static_cast<std::size_t>(kRows * (kSegments + 1) + column)], {}};
  };
  Design design;
  StylingCurve seam;
  seam.id = "seam";
  seam.way = SmoothWay{{at(12), outer(12)}, SubdivisionRule::Auto, {}, {}};
  design.curves.push_back(seam);
  for (const auto& [id, column] : {std::pair{"begin", 6}, std::pair{"rest", 60}}) {
    PieceRecord record;
    record.id = id;
    record.anchor =
        NearPosition{positions[static_cast<std::size_t>(3 * (kSegments + 1) + column)], {}};
    design.pieces.push_back(record);
  }
  const Mesh strip = test::grid(kSegments, kRows).withPositions(positions);
  const Result<Pattern> pattern =
      makePattern({std::make_shared<const Design>(design),
                   std::make_shared<const ReferenceModel>(makeReferenceModel("strip", strip))});
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  const auto told = std::find_if(pattern->findings.begin(), pattern->findings.end(),
                                 [](const Finding& f) { return f.code == "kept-apart"; });
  ASSERT_NE(told, pattern->findings.end());
  EXPECT_THAT(told->where, testing::Contains(Element::piece("rest")));
  std::size_t faces = 0;
  for (const Element& element : told->where) {
    if (element.kind != Element::Kind::Face) continue;
    ++faces;
    // The rest's own beginning, from column 12 on, and its end: by height on the model.
    const double along = strip.position(strip.vertices(FaceId(element.index))[0]).z() / 100;
    EXPECT_TRUE((along > 0.1 && along < 0.4) || along > 0.75) << along;
  }
  EXPECT_GE(faces, 2U);
}

TEST(MakePattern, StopsWhenCancelled) {
  class Stop : public Progress {
   public:
    void step(std::string_view) override {}
    [[nodiscard]] bool isCancelled() const override { return true; }
  };
  Stop stop;
  const Result<Pattern> pattern = makePattern(sleeveDocument(), {}, nullptr, &stop);
  ASSERT_FALSE(pattern);
  EXPECT_EQ(pattern.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace toile::test
