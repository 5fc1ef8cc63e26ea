// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace toile::detail {

/// Prints the broken promise with its place and aborts.
[[noreturn]] void assertionFailed(const char* condition, const char* file, int line);

}  // namespace toile::detail

/// A promise that only a bug can break. Cheap ones only: it stays on in release builds.
#define TOILE_ASSERT(condition) \
  (static_cast<bool>(condition) \
       ? static_cast<void>(0)   \
       : ::toile::detail::assertionFailed(#condition, __FILE__, __LINE__))
