// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/content_hash.h"

#include <gtest/gtest.h>

namespace toile {
namespace {

TEST(ContentHash, KeepsItsValueForEver) {
  // The hash of a connectivity stands in files: XXH3-128 of nothing is a published constant.
  EXPECT_EQ(ContentHasher().finish().hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, TellsWhereOneStringEnds) {
  EXPECT_NE(ContentHasher().add("ab").add("c").finish(),
            ContentHasher().add("a").add("bc").finish());
  EXPECT_EQ(ContentHasher().add("ab").add(1.5).finish(),
            ContentHasher().add("ab").add(1.5).finish());
  EXPECT_NE(ContentHasher().add(0.0).finish(), ContentHasher().add(-0.0).finish());
}

}  // namespace
}  // namespace toile
