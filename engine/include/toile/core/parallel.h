// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace toile {

/// Calls body(i) for every i in [0, count), on several threads. The body writes only to its own
/// slot, so that results do not depend on the number of threads. BLAS stays on one thread.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// Limits parallelFor to that many threads for the life of the object (0 = all cores).
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  std::size_t previous_;
};

}  // namespace toile
