// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace toile {

/// What a long call tells of its way, and how it is stopped. Calls may come from several threads;
/// an implementation locks. The engine passes a pointer that may be null.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A step of the data flow begins: "cut", "unfold front", ...
  virtual void step(std::string_view name) = 0;
  /// Polled between iterations; true ends the call with ErrorCode::Cancelled.
  [[nodiscard]] virtual bool isCancelled() const { return false; }
};

[[nodiscard]] inline bool isCancelled(const Progress* progress) {
  return progress != nullptr && progress->isCancelled();
}

}  // namespace toile
