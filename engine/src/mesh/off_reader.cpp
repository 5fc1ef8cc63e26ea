// SPDX-License-Identifier: GPL-3.0-or-later
// OFF as text, with the variants that carry colours, normals or texture coordinates per vertex.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/readers.h"
#include "mesh/text_scanner.h"

namespace toile::detail {
namespace {

// Numbers behind x y z in a vertex line are colours, normals and the like.
constexpr std::array<std::string_view, 8> kKeywords = {"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                       "STOFF", "STCOFF", "STNOFF", "STCNOFF"};

class OffReader {
 public:
  OffReader(std::string_view content, const std::string& name)
      : content_(content),
        scan_(content, {.comment = '#', .continued = false, .line = 1}),
        name_(name) {}

  Result<PolygonSoup> read() {
    scan_.token();  // the keyword
    std::array<std::uint64_t, 3> counts{};
    for (std::uint64_t& count : counts) {
      const Result<std::string_view> token = nextToken("the counts of vertices and faces");
      if (!token) return token.error();
      if (*token == "BINARY") {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: binary OFF is not read; save it as text", name_),
                     {Element::line(scan_.line())}};
      }
      const std::optional<std::int64_t> number = parseInteger(*token);
      if (!number || *number < 0) return fail(fmt::format("{} is no count", inQuotes(*token)));
      count = static_cast<std::uint64_t>(*number);
    }
    if (Result<void> done = readVertices(counts[0]); !done) return done.error();
    if (Result<void> done = readFaces(counts[1]); !done) return done.error();
    return std::move(soup_);
  }

 private:
  Error fail(std::string_view what) const { return lineError(name_, scan_.line(), what); }

  std::uint64_t bytesLeft() const {
    return static_cast<std::uint64_t>(content_.data() + content_.size() - scan_.position()) + 1;
  }
  Error noRoom(std::uint64_t count, std::string_view what) const {
    return fail(
        fmt::format("{} {} are announced, the file has no room for so many; it was cut "
                    "off, or the count is wrong",
                    count, what));
  }

  /// Over line ends; comments on the way are read.
  Result<std::string_view> nextToken(std::string_view what) {
    for (;;) {
      const std::string_view token = scan_.token();
      if (!token.empty()) return token;
      if (scan_.atComment()) {
        const std::uint64_t line = scan_.line();
        const std::string_view comment = scan_.restOfLine().substr(1);
        if (Result<void> done = readUnitComment(comment, name_, line, soup_); !done) {
          return done.error();
        }
      }
      if (scan_.atEnd()) return fail(fmt::format("the file ends before {}; it was cut off", what));
      scan_.nextLine();
    }
  }

  Result<void> readVertices(std::uint64_t count) {
    if (count == 0) return fail("the file has no vertices");
    if (count > kMaxVertices || 6 * count > bytesLeft()) return noRoom(count, "vertices");
    soup_.positions.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      Eigen::Vector3d position;
      for (int axis = 0; axis < 3; ++axis) {
        const Result<std::string_view> token = nextToken(fmt::format("vertex {}", i));
        if (!token) return token.error();
        const std::optional<double> value = parseNumber(*token);
        if (!value) return fail(fmt::format("{} is not a finite number", inQuotes(*token)));
        position[axis] = *value;
      }
      soup_.positions.push_back(position);
      scan_.restOfLine();
    }
    return {};
  }

  Result<void> readFaces(std::uint64_t count) {
    if (count > kMaxPolygons || 2 * count > bytesLeft()) return noRoom(count, "faces");
    soup_.polygons.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::string what = fmt::format("face {}", i);
      const Result<std::string_view> size = nextToken(what);
      if (!size) return size.error();
      const std::optional<std::int64_t> corners = parseInteger(*size);
      if (!corners || *corners < 0 || 2 * static_cast<std::uint64_t>(*corners) > bytesLeft()) {
        return fail(fmt::format("{} is no number of corners", inQuotes(*size)));
      }
      std::vector<std::uint32_t> polygon(static_cast<std::size_t>(*corners));
      for (std::uint32_t& corner : polygon) {
        const Result<std::string_view> token = nextToken(what);
        if (!token) return token.error();
        const std::optional<std::int64_t> index = parseInteger(*token);
        if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= soup_.positions.size()) {
          return fail(fmt::format("{} is no vertex number; there are {} vertices, counted from 0",
                                  inQuotes(*token), soup_.positions.size()));
        }
        corner = static_cast<std::uint32_t>(*index);
      }
      soup_.polygons.push_back(std::move(polygon));
      scan_.restOfLine();  // a colour
    }
    return {};
  }

  std::string_view content_;
  TextScanner scan_;
  const std::string& name_;
  PolygonSoup soup_;
};

}  // namespace

bool looksLikeOff(std::string_view content) {
  TextScanner scan(content, {.comment = '#', .continued = false, .line = 1});
  const std::string_view keyword = scan.token();
  return std::find(kKeywords.begin(), kKeywords.end(), keyword) != kKeywords.end();
}

Result<PolygonSoup> parseOff(std::string_view content, const std::string& name) {
  return OffReader(content, name).read();
}

}  // namespace toile::detail
