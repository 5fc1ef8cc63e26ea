// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/nearest_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace toile {
namespace {

TEST(NearestName, CountsTypingSlips) {
  const std::vector<std::string> names{"waist_girth", "hip_girth", "side_l", "side_r"};
  EXPECT_EQ(nearestName("waist_girht", names), "waist_girth");  // neighbours swapped
  EXPECT_EQ(nearestName("waistgirth", names), "waist_girth");   // one left out
  EXPECT_EQ(nearestName("hip_girths", names), "hip_girth");     // one added
  EXPECT_EQ(nearestName("side_x", names), "side_l");            // the first of several
  EXPECT_EQ(nearestName("side_r", names), "side_r");
  EXPECT_EQ(nearestName("centre_front", names), "");
  EXPECT_EQ(nearestName("", {}), "");
  EXPECT_EQ(nearestName(std::string(100000, 'x'), names), "");
}

TEST(NearestName, SuggestsOrListsWhatThereIs) {
  const std::vector<std::string> names{"front", "back"};
  EXPECT_EQ(suggestion("frnt", names), "; did you mean \"front\"?");
  EXPECT_EQ(suggestion("sleeve", names), "; there are: front, back");
  EXPECT_EQ(suggestion("sleeve", {}), "");
  std::vector<std::string> many;
  for (int i = 0; i < 15; ++i) many.push_back("curve" + std::to_string(i));
  EXPECT_TRUE(suggestion("sleeve", many).ends_with("curve11 and 3 more"));
}

}  // namespace
}  // namespace toile
