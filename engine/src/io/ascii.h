// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace toile {

/// UTF-8 as 7-bit ASCII: compatibility decomposition, marks stripped, a few letters spelled out
/// (German sharp s, o with stroke, ...), anything else and control characters as '_'.
[[nodiscard]] std::string toAscii(std::string_view utf8);

/// Upper case, only A-Z 0-9 _ -, at most `most` characters, starting with a letter or digit; empty
/// where nothing of the name can be written so.
[[nodiscard]] std::string toPlainName(std::string_view utf8, std::size_t most);

/// The name itself, or with its end replaced by -2, -3, ... so that it is new in `taken` (it is
/// added) and keeps within `most`.
[[nodiscard]] std::string makeUnique(const std::string& name, std::size_t most,
                                     std::set<std::string>& taken);

}  // namespace toile
