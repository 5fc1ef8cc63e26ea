// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/result_printing.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

TEST(BodySizes, FollowTheStandard) {
  const Result<BodySize> woman = findSize(standardSizes(), "EU38F");
  ASSERT_TRUE(woman) << woman.error();
  EXPECT_EQ(woman->options.measures.at(BodyMeasure::Chest), Length::cm(88));
  EXPECT_EQ(woman->options.masculine, 0);
  const Result<BodySize> man = findSize(standardSizes(), "EU50M");
  ASSERT_TRUE(man) << man.error();
  EXPECT_EQ(man->options.measures.at(BodyMeasure::Chest), Length::cm(100));
  EXPECT_EQ(man->options.masculine, 1);
  const Result<BodySize> none = findSize(standardSizes(), "EU39F");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::NameNotFound);
  EXPECT_THAT(none.error().message, HasSubstr("did you mean"));
}

TEST(BodySizes, YieldToMeasuresSaidBeside) {
  BodyOptions options;
  ASSERT_TRUE(setBodyOption(options, "waist", "75cm"));
  ASSERT_TRUE(setBodyOption(options, "size", "EU38F"));
  EXPECT_EQ(options.measures.at(BodyMeasure::Waist), Length::cm(75));
  EXPECT_EQ(options.measures.at(BodyMeasure::Hip), Length::cm(96));
}

TEST(BodySizes, ReadTablesOfOnesOwn) {
  const auto sizes = parseSizeTable(
      "size, form ,chest,waist\r\nS,female,84cm,\r\n\r\n\"M\",30%,88cm,70cm\r\n", "own.csv");
  ASSERT_TRUE(sizes) << sizes.error();
  ASSERT_EQ(sizes->size(), 2U);
  EXPECT_EQ((*sizes)[0].name, "S");
  EXPECT_FALSE((*sizes)[0].options.measures.contains(BodyMeasure::Waist));
  EXPECT_EQ((*sizes)[1].name, "M");
  EXPECT_DOUBLE_EQ((*sizes)[1].options.masculine, 0.3);
  const auto plain = parseSizeTable("size,chest\nS,84\n", "own.csv", FileUnit::Centimetre);
  ASSERT_TRUE(plain) << plain.error();
  EXPECT_EQ(plain->front().options.measures.at(BodyMeasure::Chest), Length::cm(84));
}

TEST(BodySizes, RefuseDamagedTablesByLine) {
  const auto message = [](const std::string& text) {
    const auto sizes = parseSizeTable(text, "own.csv");
    EXPECT_FALSE(sizes) << text;
    return sizes ? std::string() : sizes.error().message;
  };
  EXPECT_THAT(message("size,chst\nS,84cm\n"), HasSubstr("line 1: there is no column \"chst\""));
  EXPECT_THAT(message("chest\n84cm\n"), HasSubstr("one of them \"size\""));
  EXPECT_THAT(message("size,chest\nS,84cm,3\n"), HasSubstr("line 2: 3 cells"));
  EXPECT_THAT(message("size,chest\nS,84\n"), HasSubstr("line 2"));
  EXPECT_THAT(message("size,chest\nS,84cm\nS,85cm\n"),
              HasSubstr("line 3: size \"S\" stands twice"));
  EXPECT_THAT(message("size,chest\n"), HasSubstr("no size"));
  EXPECT_THAT(message(""), HasSubstr("no size"));
}

}  // namespace
}  // namespace toile
