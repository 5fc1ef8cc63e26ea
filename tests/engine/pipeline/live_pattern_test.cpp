// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/live_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <string>

#include "support/sample_designs.h"
#include "toile/core/parallel.h"
#include "toile/io/report.h"
#include "toile/io/svg.h"

// While a line is dragged: the full answer is makePattern()'s, and only touched pieces are solved.
namespace toile::test {
namespace {

std::string everything(const Pattern& pattern) {
  std::string all = writeReportJson(pattern) + writeSvg(drawSheet(pattern));
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    if (pattern.flats[i]) all += writePieceObj(pattern.cut.pieces[i], *pattern.flats[i]);
  }
  return all;
}

std::size_t count(const LiveAnswer& answer, LivePiece::State state) {
  return static_cast<std::size_t>(
      std::count_if(answer.pieces.begin(), answer.pieces.end(),
                    [&](const LivePiece& p) { return p.state == state; }));
}
std::size_t reused(const LiveAnswer& answer) {
  return static_cast<std::size_t>(std::count_if(answer.pieces.begin(), answer.pieces.end(),
                                                [](const LivePiece& p) { return p.isReused; }));
}

class LivePatternTest : public testing::Test {
 protected:
  Document sleeve_ = sleeveDocument();
  [[nodiscard]] Document tiers(double lower) const { return tieredSleeve(sleeve_, 500, lower); }
};

TEST_F(LivePatternTest, FullIsWhatMakePatternMakesWhateverCameBefore) {
  LivePattern live;
  for (const double lower : {150.0, 152.0, 160.0, 150.0}) {
    ASSERT_TRUE(live.update(tiers(lower + 0.5), Quality::Preview));
    const Result<LiveAnswer> full = live.update(tiers(lower), Quality::Full);
    ASSERT_TRUE(full) << full.error();
    EXPECT_TRUE(full->isFull());
    EXPECT_EQ(count(*full, LivePiece::State::Full), 6U);
    const Result<Pattern> plain = makePattern(tiers(lower));
    ASSERT_TRUE(plain) << plain.error();
    EXPECT_EQ(everything(full->pattern), everything(*plain));
  }
}

TEST_F(LivePatternTest, OnlyTouchedPiecesAreSolved) {
  LivePattern live;
  const Result<LiveAnswer> first = live.update(tiers(150), Quality::Full);
  ASSERT_TRUE(first) << first.error();
  EXPECT_EQ(live.counts().solved, 6U);
  EXPECT_EQ(reused(*first), 0U);

  // The lower seam bounds four of six pieces.
  const Result<LiveAnswer> quick = live.update(tiers(153), Quality::Preview);
  ASSERT_TRUE(quick) << quick.error();
  EXPECT_EQ(live.counts().previewed, 4U);
  EXPECT_EQ(live.counts().solved, 6U);
  EXPECT_EQ(count(*quick, LivePiece::State::Preview), 4U);
  EXPECT_EQ(count(*quick, LivePiece::State::Full), 2U);
  EXPECT_FALSE(quick->isFull());
  for (std::size_t i = 0; i < quick->pieces.size(); ++i) {
    const bool isSame = quick->pattern.flats[i] == first->pattern.flats[i];
    EXPECT_EQ(quick->pieces[i].isReused, isSame);
    EXPECT_EQ(isSame, quick->pieces[i].state == LivePiece::State::Full);
  }

  const Result<LiveAnswer> dropped = live.update(tiers(153), Quality::Full);
  ASSERT_TRUE(dropped) << dropped.error();
  EXPECT_EQ(live.counts().solved, 10U);
  EXPECT_EQ(reused(*dropped), 2U);

  // Undo: everything is known.
  const Result<LiveAnswer> undone = live.update(tiers(150), Quality::Preview);
  ASSERT_TRUE(undone) << undone.error();
  EXPECT_TRUE(undone->isFull());
  EXPECT_EQ(live.counts().previewed, 4U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(undone->pattern.flats[i], first->pattern.flats[i]);
  }
}

TEST_F(LivePatternTest, APreviewComesNearTheFullAnswerAndStaysInItsPlace) {
  LivePattern live;
  const Result<LiveAnswer> before = live.update(tiers(150), Quality::Full);
  ASSERT_TRUE(before) << before.error();
  const Result<LiveAnswer> quick = live.update(tiers(153), Quality::Preview);
  const Result<Pattern> full = makePattern(tiers(153));
  ASSERT_TRUE(quick && full);
  for (std::size_t i = 0; i < full->flats.size(); ++i) {
    const FlatPiece& near = *quick->pattern.flats[i];
    EXPECT_LT(near.check.maxLengthError, 2e-3);
    EXPECT_EQ(near.check.flippedFaces, 0U);
    double farthest = 0;
    for (std::size_t v = 0; v < near.position.size(); ++v) {
      farthest = std::max(
          farthest, (near.position[VertexId(v)] - full->flats[i]->position[VertexId(v)]).norm());
    }
    EXPECT_LT(farthest, 2) << full->cut.pieces[i].name << ", mm";
  }
  ASSERT_EQ(quick->pattern.layout.placements.size(), before->pattern.layout.placements.size());
  for (std::size_t k = 0; k < quick->pattern.layout.placements.size(); ++k) {
    EXPECT_EQ(quick->pattern.layout.placements[k].offset,
              before->pattern.layout.placements[k].offset);
  }
}

/// Stops after so many questions.
class StopAfter : public Progress {
 public:
  explicit StopAfter(int polls) : left_(polls) {}
  void step(std::string_view) override {}
  [[nodiscard]] bool isCancelled() const override { return left_-- <= 0; }

 private:
  mutable std::atomic<int> left_;
};

TEST_F(LivePatternTest, AStoppedCallLeavesNoTrace) {
  LivePattern live;
  const Result<LiveAnswer> first = live.update(tiers(150), Quality::Full);
  ASSERT_TRUE(first) << first.error();
  std::size_t stopped = 0;
  for (int polls = 0; polls < 12; ++polls) {
    for (const Quality quality : {Quality::Preview, Quality::Full}) {
      StopAfter stop(polls);
      const Result<LiveAnswer> answer = live.update(tiers(155 + polls), quality, &stop);
      if (answer) continue;
      ++stopped;
      EXPECT_EQ(answer.error().code, ErrorCode::Cancelled);
    }
  }
  EXPECT_GE(stopped, 12U);
  const Result<LiveAnswer> full = live.update(tiers(150), Quality::Full);
  const Result<Pattern> plain = makePattern(tiers(150));
  ASSERT_TRUE(full && plain);
  EXPECT_EQ(everything(full->pattern), everything(*plain));
}

TEST_F(LivePatternTest, APieceThatFailsDoesNotStopTheOthers) {
  Design design = *sleeve_.design;
  // A loop in the middle of nowhere leaves a tube above and one below.
  design.curves.clear();
  design.pieces.clear();
  design.curves.push_back(ringSeam("ring", 300));
  LivePattern live;
  for (const Quality quality : {Quality::Preview, Quality::Full}) {
    const Result<LiveAnswer> answer = live.update(withDesign(sleeve_, design), quality);
    ASSERT_TRUE(answer) << answer.error();
    EXPECT_EQ(count(*answer, LivePiece::State::Failed), 2U);
    for (const auto& failure : answer->pattern.failures) {
      ASSERT_TRUE(failure);
      EXPECT_EQ(failure->code, ErrorCode::NotADisk);
    }
  }
}

TEST_F(LivePatternTest, ProcessedPiecesAreKeptAndCarryTheNamesOfTheDocument) {
  Design design = *sleeve_.design;
  design.pieces.front().develop = DevelopSetting{Ratio::of(0.5), {}, {}, {}};
  LivePattern live;
  ASSERT_TRUE(live.update(withDesign(sleeve_, design), Quality::Full));
  design.pieces.front().name = "another name";
  const Document renamed = withDesign(sleeve_, design);
  const Result<LiveAnswer> full = live.update(renamed, Quality::Full);
  ASSERT_TRUE(full) << full.error();
  EXPECT_EQ(live.counts().solved, 2U);
  EXPECT_EQ(reused(*full), 2U);
  ASSERT_TRUE(full->pattern.developed[0]);
  EXPECT_EQ(full->pattern.developed[0]->piece.name, "another name");
  const Result<Pattern> plain = makePattern(renamed);
  ASSERT_TRUE(plain) << plain.error();
  EXPECT_EQ(everything(full->pattern), everything(*plain));
}

}  // namespace
}  // namespace toile::test
