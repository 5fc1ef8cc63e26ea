// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/hpgl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "io/stroke_font.h"
#include "support/hand_made_pattern.h"
#include "support/result_printing.h"

namespace toile {
namespace {

TEST(Hpgl, HoldsOnlyTheSafeCommands) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const Result<std::string> plot = writeHpgl(drawSheet(pattern), {.version2 = false});
  ASSERT_TRUE(plot) << plot.error();
  std::istringstream lines(*plot);
  std::string last;
  for (std::string line; std::getline(lines, line); last = line) {
    EXPECT_LE(line.size(), 201u);
    EXPECT_EQ(line.back(), ';');
    EXPECT_TRUE(line.starts_with("IN") || line.starts_with("PA") || line.starts_with("PU") ||
                line.starts_with("PD") || line.starts_with("SP"))
        << line;
    EXPECT_EQ(line.find('-'), std::string::npos);  // nothing left of the origin
  }
  EXPECT_EQ(last, "SP0;");
}

TEST(Hpgl, CutsTheOutlineOfAPieceLast) {
  Pattern pattern = test::makeTwoPiecePattern();
  Outline hole;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(50, 50), Eigen::Vector2d(50, 80),
                                   Eigen::Vector2d(80, 80), Eigen::Vector2d(80, 50)})
    hole.push_back({p, true});
  pattern.pieces.resize(1);
  pattern.layout.placements.resize(1);
  pattern.pieces[0].cutLines.push_back(hole);
  const std::string plot = *writeHpgl(drawSheet(pattern));
  const std::size_t outline = plot.rfind("PU", plot.rfind("PD"));
  const std::size_t before = plot.rfind("PD", outline - 1);
  // The one before the outline is the hole: 30 mm are 1200 units.
  EXPECT_EQ(std::count(plot.begin() + static_cast<std::ptrdiff_t>(before),
                       plot.begin() + static_cast<std::ptrdiff_t>(outline), ','),
            7);
}

TEST(Hpgl, RefusesWhatThePlotterCannotHold) {
  Pattern pattern = test::makeTwoPiecePattern();
  EXPECT_EQ(writeHpgl(drawSheet(pattern), {.cutPen = 9}).error().code, ErrorCode::InvalidArgument);
  EXPECT_EQ(writeHpgl(drawSheet(pattern), {.overcut = -1}).error().code,
            ErrorCode::InvalidArgument);
  pattern.layout.placements[1].offset.x() += 800;
  EXPECT_TRUE(writeHpgl(drawSheet(pattern)));
  EXPECT_EQ(writeHpgl(drawSheet(pattern), {.version2 = false}).error().code,
            ErrorCode::Unsupported);
}

TEST(StrokeFont, DrawsEveryLetterWithinItsBox) {
  for (char c = 'A'; c <= 'Z'; ++c) EXPECT_FALSE(strokeText({c}, {0, 0}, 6, 0).empty()) << c;
  for (char c = '0'; c <= '9'; ++c) EXPECT_FALSE(strokeText({c}, {0, 0}, 6, 0).empty()) << c;
  const std::string text = "Ärmel 12-A, links";
  const double half = 0.5 * 6 * strokeTextWidth(text);
  for (const Points2& stroke : strokeText(text, {0, 0}, 6, 0))
    for (const Eigen::Vector2d& p : stroke) {
      EXPECT_LE(std::abs(p.x()), half);
      EXPECT_GE(p.y(), 0);
      EXPECT_LE(p.y(), 6);
    }
}

}  // namespace
}  // namespace toile
