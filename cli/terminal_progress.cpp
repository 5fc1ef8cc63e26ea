// SPDX-License-Identifier: GPL-3.0-or-later
#include "terminal_progress.h"

#include <csignal>
#include <cstdio>

namespace toile::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// The second Ctrl+C ends the program at once.
void onInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

TerminalProgress::TerminalProgress() {
  std::signal(SIGINT, onInterrupt);
}

void TerminalProgress::step(std::string_view name) {
  const std::lock_guard lock(mutex_);
  std::fprintf(stderr, "  %.*s\n", static_cast<int>(name.size()), name.data());
}

bool TerminalProgress::isCancelled() const {
  return interrupted != 0;
}

}  // namespace toile::cli
