// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ostream>

#include "toile/core/result.h"

namespace toile {

/// So that `ASSERT_TRUE(result) << result.error()` tells what went wrong.
inline std::ostream& operator<<(std::ostream& out, const Error& error) {
  return out << toString(error.code) << ": " << error.message;
}

}  // namespace toile
