// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "toile/design/design.h"

namespace toile {

/// Version of the `*.toile` format that this program writes.
inline constexpr int kDesignFormatVersion = 1;

/// Reads `*.toile` text (docs/file-format.md, docs/toile.schema.json).
///
/// Unknown keys are kept. A newer version, a wrong type, a missing or doubled id, a value out of
/// range is a FileFormat error with the line, or the path of the key such as /curves/3/way.
Result<Design> parseDesign(std::string_view json, const std::string& file);
Result<Design> readDesign(const std::filesystem::path& path);

/// Canonical text: known keys in the documented order, then unknown ones; two spaces; numbers read
/// back bit for bit. parse(write(d)) == d and write(parse(t)) == t for texts written by Toile.
std::string writeDesign(const Design& design);

}  // namespace toile
