// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace toile {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  // One item a task: items are pieces or image tiles, few and large.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
}

struct ThreadLimit::Control {
  tbb::global_control tbb;
};

ThreadLimit::ThreadLimit(std::size_t threads) {
  if (threads > 0) {
    control_ = std::make_unique<Control>(
        Control{tbb::global_control(tbb::global_control::max_allowed_parallelism, threads)});
  }
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace toile
