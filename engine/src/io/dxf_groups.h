// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "toile/core/result.h"

namespace toile {

/// The part of a DXF that a pattern reader needs, safe to hand to a parser.
struct DxfGroups {
  std::string text;  ///< entities that patterns are drawn with, blocks, and the header
  std::map<std::string, std::size_t> leftOut;  ///< entity -> how many
};

/// Looks at every group code and value before a parser does: the file is whole, its codes are
/// numbers, no line is longer than a parser holds, no count is larger than the file.
/// @return FileFormat with the line
Result<DxfGroups> checkDxfGroups(std::string_view file);

}  // namespace toile
