// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <string_view>

#include "toile/core/progress.h"

namespace toile::cli {

/// Tells the steps of the work on stderr, one line each; Ctrl+C ends the work between two steps of
/// a solver and leaves no half files.
class TerminalProgress : public Progress {
 public:
  TerminalProgress();
  void step(std::string_view name) override;
  [[nodiscard]] bool isCancelled() const override;

 private:
  std::mutex mutex_;
};

}  // namespace toile::cli
