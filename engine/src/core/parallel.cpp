// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace toile {

namespace {

std::atomic<std::size_t> threadLimit{0};

}  // namespace

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  const std::size_t limit = threadLimit;
  if (limit == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  // TBB orders the caller's writes before the bodies and theirs before its return. A thread checker
  // cannot see that into the library: these two say it again, at no cost that one could measure.
  std::atomic<bool> begun = false;
  std::atomic<std::size_t> ended = 0;
  begun.store(true, std::memory_order_release);
  tbb::task_arena arena(limit == 0 ? tbb::task_arena::automatic : static_cast<int>(limit));
  // One item a task: items are pieces or image tiles, few and large.
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          static_cast<void>(begun.load(std::memory_order_acquire));
          for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
          ended.fetch_add(1, std::memory_order_release);
        },
        tbb::simple_partitioner());
  });
  static_cast<void>(ended.load(std::memory_order_acquire));
}

ThreadLimit::ThreadLimit(std::size_t threads) : previous_(threadLimit.exchange(threads)) {}

ThreadLimit::~ThreadLimit() {
  threadLimit = previous_;
}

}  // namespace toile
