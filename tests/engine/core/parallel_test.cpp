// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/parallel.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace toile {
namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const ThreadLimit limit(threads);
    std::vector<int> visits(10000, 0);
    parallelFor(visits.size(), [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
  }
}

TEST(Parallel, OneThreadMeansOne) {
  const ThreadLimit limit(1);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  parallelFor(1000, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(seen.size(), 1U);
}

}  // namespace
}  // namespace toile
