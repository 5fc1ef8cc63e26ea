// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace toile {

/// Text as it stands in XML and HTML, in an element or a quoted attribute. Control characters,
/// which XML 1.0 cannot write, become spaces.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace toile
