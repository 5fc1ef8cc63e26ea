// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "toile/design/design.h"

namespace toile {

struct FileDate {
  int year = 0, month = 0, day = 0;
  int hour = 0, minute = 0, second = 0;
};

/// The date that files carry: of the order, else of SOURCE_DATE_EPOCH (UTC), else none. Never the
/// clock's, so that equal input gives equal bytes.
[[nodiscard]] std::optional<FileDate> fileDate(const Design& design);

}  // namespace toile
