// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace toile {
namespace {

TEST(Units, ReadLengthsAsPeopleWriteThem) {
  EXPECT_EQ(parseLength("12mm")->mm(), 12);
  EXPECT_EQ(parseLength(" 1.5 cm ")->mm(), 15);
  EXPECT_EQ(parseLength("0.9m")->mm(), 900);
  EXPECT_EQ(parseLength("3/8in")->mm(), 0.375 * 25.4);
  EXPECT_EQ(parseLength("1 1/2in")->mm(), 1.5 * 25.4);
  EXPECT_EQ(parseLength("-1 1/2in")->mm(), -1.5 * 25.4);
}

TEST(Units, RefuseWhatIsNoLength) {
  for (const char* text : {"", "12", "mm", "12 furlong", "1,5cm", "nanmm", "infmm", "1/0in",
                           "1e999mm", "+-3mm", "1 /2 /3in", "0x10mm"}) {
    const Result<Length> length = parseLength(text);
    ASSERT_FALSE(length) << text;
    EXPECT_EQ(length.error().code, ErrorCode::InvalidArgument) << text;
  }
}

TEST(Units, TextReadsBackBitForBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-12, 12);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(random));
    EXPECT_EQ(parseLength(toString(Length::mm(value)))->mm(), value);
    EXPECT_EQ(parseRatio(toString(Ratio::of(value)))->value(), value);
    EXPECT_EQ(parseAngle(toString(Angle::radians(value)))->radians(), value);
    EXPECT_EQ(parseDouble(formatExact(-value)), -value);
  }
}

TEST(Units, RatiosAndAngles) {
  EXPECT_EQ(parseRatio("2%")->value(), 0.02);
  EXPECT_EQ(parseRatio("0.02")->value(), 0.02);
  EXPECT_FALSE(parseRatio("2 mm"));
  EXPECT_DOUBLE_EQ(parseAngle("180deg")->radians(), std::numbers::pi);
  EXPECT_FALSE(parseAngle("180"));
}

}  // namespace
}  // namespace toile
