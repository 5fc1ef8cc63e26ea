// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/colour.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

TEST(Colour, IsReadAndWrittenAsHex) {
  EXPECT_EQ(parseColour("#1a2B3c"), colourOf(0x1A2B3C));
  EXPECT_EQ(toHex(colourOf(0x1A2B3C)), "#1a2b3c");
  for (const char* text : {"", "#", "1a2b3c", "#1a2b3", "#1a2b3c4", "#1a2b3g", "#-1a2b3", "red"}) {
    EXPECT_EQ(parseColour(text), std::nullopt) << text;
  }
}

TEST(Colour, SurvivesTheWayThroughLinearLight) {
  for (int value = 0; value < 256; ++value) {
    const Colour grey = mix({0, 0, 0}, {255, 255, 255}, value / 255.0);
    EXPECT_EQ(grey.r, value);
    // The table has 4096 steps: in the dark one step is nearly one of 255.
    EXPECT_NEAR(toDisplay(linearOf(grey)).x() * 255, value, 0.5) << value;
  }
}

}  // namespace
}  // namespace toile
