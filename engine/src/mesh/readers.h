// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "toile/mesh/mesh_file.h"

/// One reader per file format, and what they share. `name` is the file's name for messages.
namespace toile::detail {

/// A chosen limit, so that ids fit and a small damaged file cannot ask for all memory.
inline constexpr std::uint64_t kMaxVertices = 100'000'000;
inline constexpr std::uint64_t kMaxPolygons = 200'000'000;

/// `folder` is where files named inside are looked for; empty: they are not looked for.
Result<PolygonSoup> parseObj(std::string_view content, const std::string& name,
                             const std::filesystem::path& folder = {});
Result<PolygonSoup> parsePly(std::string_view content, const std::string& name);
Result<PolygonSoup> parseStl(std::string_view content, const std::string& name);
Result<PolygonSoup> parseOff(std::string_view content, const std::string& name);

[[nodiscard]] bool looksLikePly(std::string_view content);
[[nodiscard]] bool looksLikeOff(std::string_view content);
[[nodiscard]] bool looksLikeStl(std::string_view content);

/// FileFormat: "name, line 12: what".
[[nodiscard]] Error lineError(const std::string& name, std::uint64_t line, std::string_view what);
/// FileFormat: "name, byte 1234: what".
[[nodiscard]] Error byteError(const std::string& name, std::uint64_t byte, std::string_view what);
/// A piece of the user's text for a message: short, printable, in quotes.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// Takes a comment's text (without its mark). A `toile-units: mm` comment sets the unit of the
/// soup; an unknown unit, or a second one that differs, is an error.
Result<void> readUnitComment(std::string_view comment, const std::string& name, std::uint64_t line,
                             PolygonSoup& soup);

}  // namespace toile::detail
