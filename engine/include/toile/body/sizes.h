// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "toile/body/body.h"

namespace toile {

/// A size and the body that it means.
struct BodySize {
  std::string name;  ///< "EU38F"
  BodyOptions options;
};

/// Girths of EN 13402-3 and the heights usual with them: women EU32F to EU54F, men EU44M to EU62M
/// by half the chest girth, children EU104C to EU164C by height.
const std::vector<BodySize>& standardSizes();

/// @return NameNotFound with the nearest names.
Result<BodySize> findSize(const std::vector<BodySize>& sizes, std::string_view name);

/// A table of one's own, comma separated, the first line naming the columns: "size" and any names
/// of setBodyOption(). An empty cell says nothing.
/// @param unit of lengths written without one; refused otherwise
/// @return FileFormat with the line; at most 1000 lines.
Result<std::vector<BodySize>> parseSizeTable(std::string_view csv, const std::string& file,
                                             std::optional<FileUnit> unit = std::nullopt);

}  // namespace toile
