// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ: v, f, l, g and the comments that Toile writes. Other statements do not change the
// shape and are passed over; unknown ones are counted.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/readers.h"
#include "mesh/text_scanner.h"

namespace toile::detail {
namespace {

constexpr std::array<std::string_view, 15> kPassedOver = {
    "vt",  "vn",    "vp",       "o",        "s",          "usemtl",    "mg",    "p",
    "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "maplib"};

class ObjReader {
 public:
  ObjReader(std::string_view content, const std::string& name, const std::filesystem::path& folder)
      : scan_(content, {.comment = '#', .continued = true, .line = 1}),
        name_(name),
        folder_(folder) {
    // Typical lines are 30 to 45 bytes, two thirds of them faces.
    soup_.positions.reserve(content.size() / 120);
    soup_.polygons.reserve(content.size() / 60);
  }

  Result<PolygonSoup> read() {
    for (; !scan_.atEnd(); scan_.nextLine()) {
      if (scan_.atComment()) {
        if (Result<void> done = readComment(); !done) return done.error();
        continue;
      }
      const std::string_view key = scan_.token();
      if (key.empty()) continue;
      Result<void> done;
      if (key == "v") {
        done = readVertex();
      } else if (key == "f" || key == "fo") {
        done = readFace();
      } else if (key == "l") {
        done = readChain();
      } else if (key == "g") {
        group_ = groupName();
      } else if (key == "mtllib") {
        noteMaterialFile();
      } else if (std::find(kPassedOver.begin(), kPassedOver.end(), key) == kPassedOver.end()) {
        noteUnknown(key);
      }
      if (!done) return done.error();
    }
    return finish();
  }

 private:
  Error fail(std::string_view what) const { return lineError(name_, line_, what); }

  Result<void> readVertex() {
    line_ = scan_.line();
    // x y z, then a weight or a colour, which are checked to be numbers and not used.
    std::array<double, 3> xyz{};
    std::size_t count = 0;
    for (std::string_view token = scan_.token(); !token.empty(); token = scan_.token(), ++count) {
      const std::optional<double> value = parseNumber(token);
      if (!value) {
        return fail(fmt::format("{} is not a finite number{}", inQuotes(token),
                                token.find(',') != token.npos
                                    ? "; numbers are written with a point, not a comma"
                                    : ""));
      }
      if (count < 3) xyz[count] = *value;
    }
    if (count < 3) return fail(fmt::format("a vertex needs 3 numbers, this one has {}", count));
    if (soup_.positions.size() >= kMaxVertices) return fail("too many vertices");
    soup_.positions.emplace_back(xyz[0], xyz[1], xyz[2]);
    return {};
  }

  /// "7", "7/1", "7//3", "7/1/3", and negative numbers that count back from here.
  Result<std::uint32_t> readCorner(std::string_view token) {
    const std::string_view number = token.substr(0, token.find('/'));
    const std::optional<std::int64_t> index = parseInteger(number);
    if (!index) return fail(fmt::format("{} is not a vertex number", inQuotes(token)));
    if (*index == 0) return fail("vertex number 0: OBJ counts vertices from 1");
    const auto count = static_cast<std::int64_t>(soup_.positions.size());
    if (*index < 0) {
      if (*index < -count) {
        return fail(fmt::format("vertex number {}: only {} vertices so far", *index, count));
      }
      return static_cast<std::uint32_t>(count + *index);
    }
    if (*index > static_cast<std::int64_t>(kMaxVertices)) {
      return fail(fmt::format("vertex number {}: no file has so many vertices", *index));
    }
    // Faces may stand before their vertices, so the largest number is judged at the end.
    if (*index > largestIndex_) {
      largestIndex_ = *index;
      lineOfLargest_ = line_;
    }
    return static_cast<std::uint32_t>(*index - 1);
  }

  Result<void> readCorners(std::vector<std::uint32_t>& corners) {
    line_ = scan_.line();
    for (std::string_view token = scan_.token(); !token.empty(); token = scan_.token()) {
      const Result<std::uint32_t> corner = readCorner(token);
      if (!corner) return corner.error();
      corners.push_back(*corner);
    }
    return {};
  }

  Result<void> readFace() {
    scratch_.clear();
    if (Result<void> done = readCorners(scratch_); !done) return done;
    if (scratch_.size() < 3) {
      return fail(fmt::format("a face needs 3 vertices, this one has {}", scratch_.size()));
    }
    if (soup_.polygons.size() >= kMaxPolygons) return fail("too many faces");
    soup_.polygons.emplace_back(scratch_.begin(), scratch_.end());
    return {};
  }

  Result<void> readChain() {
    PolygonSoup::Chain chain;
    chain.group = group_;
    chain.line = scan_.line();
    if (Result<void> done = readCorners(chain.vertices); !done) return done;
    if (chain.vertices.size() < 2) {
      return fail(fmt::format("a line needs 2 vertices, this one has {}", chain.vertices.size()));
    }
    soup_.chains.push_back(std::move(chain));
    return {};
  }

  Result<void> readComment() {
    std::string_view text = scan_.restOfLine();
    text.remove_prefix(1);
    line_ = scan_.line();
    TextScanner words(text, {.comment = 0, .continued = false, .line = line_});
    const std::string_view key = words.token();
    if (key == "toile-units:") return readUnitComment(text, name_, line_, soup_);
    if (key != "target") return {};
    const std::string_view wire = words.token();
    const std::string_view edge = words.token();
    const std::optional<double> mm = parseNumber(words.token());
    if (!mm || *mm <= 0 || !parseInteger(edge) || !words.token().empty()) {
      return fail("a target is written \"# target <wire> <edge> <mm>\" with a length above 0");
    }
    soup_.targets[fmt::format("{} {}", wire, edge)] = *mm;
    return {};
  }

  /// All names of the line, one blank between them.
  std::string groupName() {
    std::string group;
    for (std::string_view token = scan_.token(); !token.empty(); token = scan_.token()) {
      if (!group.empty()) group += ' ';
      group += token;
    }
    return group;
  }

  void noteMaterialFile() {
    if (folder_.empty()) return;
    const std::uint64_t line = scan_.line();
    std::error_code ignored;
    const std::string file(scan_.restOfLine());
    if (file.empty() || std::filesystem::exists(folder_ / file, ignored)) return;
    soup_.findings.push_back({"material-file-missing",
                              fmt::format("{}, line {}: the material file {} is not there; the "
                                          "shape does not need it",
                                          name_, line, inQuotes(file)),
                              {Element::line(line)}});
  }

  void noteUnknown(std::string_view key) {
    if (unknownCount_++ == 0) {
      firstUnknown_ = inQuotes(key);
      lineOfUnknown_ = scan_.line();
    }
  }

  Result<PolygonSoup> finish() {
    if (largestIndex_ > static_cast<std::int64_t>(soup_.positions.size())) {
      return lineError(name_, lineOfLargest_,
                       fmt::format("vertex number {}: the file has {} vertices", largestIndex_,
                                   soup_.positions.size()));
    }
    if (soup_.positions.empty()) {
      if (unknownCount_ > 0) {
        return lineError(
            name_, lineOfUnknown_,
            fmt::format("{} is no OBJ statement, and the file has no vertices", firstUnknown_));
      }
      return Error{ErrorCode::FileFormat, fmt::format("{}: the file has no vertices", name_), {}};
    }
    if (unknownCount_ > 0) {
      soup_.findings.push_back(
          {"unknown-statement",
           fmt::format("{}: {} lines passed over, the first is line {} with {}", name_,
                       unknownCount_, lineOfUnknown_, firstUnknown_),
           {Element::line(lineOfUnknown_)}});
    }
    return std::move(soup_);
  }

  TextScanner scan_;
  const std::string& name_;
  const std::filesystem::path& folder_;
  PolygonSoup soup_;
  std::string group_;
  std::vector<std::uint32_t> scratch_;
  std::uint64_t line_ = 1;  // where the statement being read begins
  std::int64_t largestIndex_ = 0;
  std::uint64_t lineOfLargest_ = 0;
  std::size_t unknownCount_ = 0;
  std::string firstUnknown_;
  std::uint64_t lineOfUnknown_ = 0;
};

}  // namespace

Result<PolygonSoup> parseObj(std::string_view content, const std::string& name,
                             const std::filesystem::path& folder) {
  return ObjReader(content, name, folder).read();
}

}  // namespace toile::detail
