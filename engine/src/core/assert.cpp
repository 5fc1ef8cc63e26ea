// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/assert.h"

#include <cstdio>
#include <cstdlib>

namespace toile::detail {

void assertionFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "toile: internal error, please report it: %s (%s:%d)\n", condition, file,
               line);
  std::abort();
}

}  // namespace toile::detail
