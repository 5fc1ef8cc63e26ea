// SPDX-License-Identifier: GPL-3.0-or-later
// STL, binary and ASCII. The normals in the file are not used: the corners' order says the outside.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "mesh/readers.h"
#include "mesh/text_scanner.h"

namespace toile::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kCountBytes = 4;
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, 2 bytes of attributes
constexpr std::size_t kNormalBytes = 12;

std::uint32_t countOf(std::string_view content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + kHeaderBytes, kCountBytes);
  return count;
}

bool isBinary(std::string_view content) {
  if (content.size() < kHeaderBytes + kCountBytes) return false;
  const std::uint64_t room = content.size() - kHeaderBytes - kCountBytes;
  // Headers of binary files may begin with "solid" too: the length decides.
  return room == kTriangleBytes * std::uint64_t{countOf(content)};
}

bool isAscii(std::string_view content) {
  TextScanner scan(content, {.comment = 0, .continued = false, .line = 1});
  if (scan.tokenOfText() != "solid") return false;
  scan.nextLine();
  const std::string_view next = scan.tokenOfText();
  return next == "facet" || next == "endsolid";
}

void addTriangle(PolygonSoup& soup) {
  const auto end = static_cast<std::uint32_t>(soup.positions.size());
  soup.polygons.push_back({end - 3, end - 2, end - 1});
}

Result<PolygonSoup> parseBinary(std::string_view content, const std::string& name) {
  constexpr std::size_t kBegin = kHeaderBytes + kCountBytes;
  if (content.size() < kBegin) {
    return Error{ErrorCode::FileFormat,
                 fmt::format("{}: neither ASCII STL nor long enough for binary STL", name),
                 {}};
  }
  const std::uint64_t count = countOf(content);
  const std::uint64_t room = (content.size() - kBegin) / kTriangleBytes;
  if (count > room) {
    return byteError(name, kHeaderBytes,
                     fmt::format("the header says {} triangles, the file has room for {}; it was "
                                 "cut off, or it is no STL file",
                                 count, room));
  }
  PolygonSoup soup;
  soup.positions.reserve(3 * count);
  soup.polygons.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t at = kBegin + i * kTriangleBytes + kNormalBytes;
    std::array<float, 9> numbers{};
    std::memcpy(numbers.data(), content.data() + at, sizeof numbers);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const float* xyz = numbers.data() + 3 * corner;
      if (!std::isfinite(xyz[0]) || !std::isfinite(xyz[1]) || !std::isfinite(xyz[2])) {
        return byteError(name, at + 12 * corner,
                         fmt::format("triangle {} has a coordinate that is no finite number", i));
      }
      soup.positions.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
    addTriangle(soup);
  }
  if (content.size() != kBegin + count * kTriangleBytes) {
    soup.findings.push_back({"trailing-data",
                             fmt::format("{}: there is more in the file than its {} triangles; the "
                                         "rest was left out",
                                         name, count),
                             {}});
  }
  return soup;
}

/// solid NAME, facet normal n n n, outer loop, vertex x y z (three times), endloop, endfacet,
/// endsolid; several solids may follow each other.
class AsciiReader {
 public:
  AsciiReader(std::string_view content, const std::string& name)
      : scan_(content, {.comment = 0, .continued = false, .line = 1}), name_(name) {}

  Result<PolygonSoup> read() {
    bool inSolid = false;
    for (;;) {
      const std::string_view word = scan_.tokenOfText();
      if (word == "solid") {
        inSolid = true;
        scan_.restOfLine();
      } else if (word == "endsolid") {
        inSolid = false;
        scan_.restOfLine();
      } else if (word == "facet" && inSolid) {
        if (Result<void> done = readFacet(); !done) return done.error();
      } else if (word.empty()) {
        if (inSolid) return fail("the file ends within a solid; it was cut off");
        return std::move(soup_);
      } else {
        return fail(fmt::format("{} where a facet should begin", inQuotes(word)));
      }
    }
  }

 private:
  Error fail(std::string_view what) const { return lineError(name_, scan_.line(), what); }

  Result<void> expect(std::string_view word) {
    const std::string_view found = scan_.tokenOfText();
    if (found == word) return {};
    if (found.empty()) return fail("the file ends within a facet; it was cut off");
    return fail(fmt::format("{} where \"{}\" should be", inQuotes(found), word));
  }

  Result<void> readFacet() {
    scan_.restOfLine();  // the normal
    if (Result<void> done = expect("outer"); !done) return done;
    if (Result<void> done = expect("loop"); !done) return done;
    for (int corner = 0; corner < 3; ++corner) {
      if (Result<void> done = expect("vertex"); !done) return done;
      Eigen::Vector3d position;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view token = scan_.tokenOfText();
        const std::optional<double> value = parseNumber(token);
        if (!value && token.empty()) return fail("the file ends within a facet; it was cut off");
        if (!value) return fail(fmt::format("{} is not a finite number", inQuotes(token)));
        position[axis] = *value;
      }
      if (soup_.positions.size() >= kMaxVertices) return fail("too many triangles");
      soup_.positions.push_back(position);
    }
    addTriangle(soup_);
    if (Result<void> done = expect("endloop"); !done) return done;
    return expect("endfacet");
  }

  TextScanner scan_;
  const std::string& name_;
  PolygonSoup soup_;
};

}  // namespace

bool looksLikeStl(std::string_view content) {
  return isBinary(content) || isAscii(content);
}

Result<PolygonSoup> parseStl(std::string_view content, const std::string& name) {
  Result<PolygonSoup> soup = !isBinary(content) && isAscii(content)
                                 ? AsciiReader(content, name).read()
                                 : parseBinary(content, name);
  if (!soup) return soup;
  soup->repeatsPositions = true;
  if (soup->polygons.empty()) {
    return Error{ErrorCode::FileFormat, fmt::format("{}: the file has no triangles", name), {}};
  }
  return soup;
}

}  // namespace toile::detail
