// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/readers.h"
#include "toile/core/file.h"

namespace toile {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

std::string lowerExtension(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

Result<PolygonSoup> parse(std::string_view content, const std::string& name,
                          const std::filesystem::path& folder) {
  const auto fail = [&](std::string_view what) {
    return Error{ErrorCode::FileFormat, fmt::format("{}: {}", name, what), {}};
  };
  if (content.empty()) return fail("the file is empty");
  const std::string extension = lowerExtension(name);
  std::string_view text = content;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());

  // First words that leave no doubt count more than the extension.
  if (detail::looksLikePly(text)) return detail::parsePly(text, name);
  if (detail::looksLikeOff(text)) return detail::parseOff(text, name);
  if (extension == ".stl") return detail::parseStl(content, name);
  if (extension == ".obj") return detail::parseObj(text, name, folder);
  if (extension == ".ply") return fail("this is no PLY file: it does not begin with \"ply\"");
  if (extension == ".off") return fail("this is no OFF file: it does not begin with \"OFF\"");
  if (detail::looksLikeStl(content)) return detail::parseStl(content, name);
  return fail("unknown kind of file; Toile reads OBJ, PLY, STL and OFF meshes");
}

}  // namespace

namespace detail {

Error lineError(const std::string& name, std::uint64_t line, std::string_view what) {
  return {ErrorCode::FileFormat,
          fmt::format("{}, line {}: {}", name, line, what),
          {Element::line(line)}};
}

Error byteError(const std::string& name, std::uint64_t byte, std::string_view what) {
  return {ErrorCode::FileFormat,
          fmt::format("{}, byte {}: {}", name, byte, what),
          {Element::byte(byte)}};
}

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string out = "\"";
  for (const char c : text.substr(0, kMost)) out += c >= 32 && c < 127 ? c : '?';
  if (text.size() > kMost) out += "...";
  return out + "\"";
}

Result<void> readUnitComment(std::string_view comment, const std::string& name, std::uint64_t line,
                             PolygonSoup& soup) {
  constexpr std::string_view kBlanks = " \t";
  constexpr std::string_view kKey = "toile-units:";
  const std::size_t begin = comment.find_first_not_of(kBlanks);
  if (begin == comment.npos || !comment.substr(begin).starts_with(kKey)) return {};
  std::string_view text = comment.substr(begin + kKey.size());
  const std::size_t first = text.find_first_not_of(kBlanks);
  text = first == text.npos ? std::string_view() : text.substr(first);
  text = text.substr(0, text.find_last_not_of(kBlanks) + 1);
  const Result<FileUnit> unit = parseFileUnit(text);
  if (!unit) return lineError(name, line, unit.error().message);
  if (soup.unit && *soup.unit != *unit) {
    return lineError(name, line,
                     fmt::format("the unit is {} here and {} further up; leave one of the two",
                                 toString(*unit), toString(*soup.unit)));
  }
  soup.unit = *unit;
  return {};
}

}  // namespace detail

Result<PolygonSoup> parsePolygonSoup(std::string_view content, const std::string& name) {
  return parse(content, name, {});
}

Result<PolygonSoup> readPolygonSoup(const std::filesystem::path& path) {
  const Result<std::string> content = readFile(path);
  if (!content) return content.error();
  const std::filesystem::path folder = path.parent_path();
  return parse(*content, path.string(), folder.empty() ? "." : folder);
}

Result<MeshFile> readMesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
  Result<PolygonSoup> soup = readPolygonSoup(path);
  if (!soup) return soup.error();
  Result<MeshFile> file = makeMeshFromSoup(std::move(*soup), options);
  if (!file) {
    Error error = file.error();
    error.message = fmt::format("{}: {}", path.string(), error.message);
    return error;
  }
  return file;
}

}  // namespace toile
