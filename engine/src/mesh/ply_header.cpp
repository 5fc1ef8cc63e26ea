// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/readers.h"
#include "mesh/text_scanner.h"

namespace toile::detail {
namespace {

// More than any program writes; keeps a header of garbage short.
constexpr std::size_t kMaxElements = 64;
constexpr std::size_t kMaxProperties = 256;

std::optional<PlyType> parseType(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::Int8},
      {"uchar", PlyType::Uint8},
      {"short", PlyType::Int16},
      {"ushort", PlyType::Uint16},
      {"int", PlyType::Int32},
      {"uint", PlyType::Uint32},
      {"float", PlyType::Float32},
      {"double", PlyType::Float64},
      {"int8", PlyType::Int8},
      {"uint8", PlyType::Uint8},
      {"int16", PlyType::Int16},
      {"uint16", PlyType::Uint16},
      {"int32", PlyType::Int32},
      {"uint32", PlyType::Uint32},
      {"float32", PlyType::Float32},
      {"float64", PlyType::Float64},
  }};
  for (const auto& [word, type] : kTypes) {
    if (word == text) return type;
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view content, const std::string& name)
      : content_(content),
        name_(name),
        scan_(content, {.comment = 0, .continued = false, .line = 1}) {}

  Result<PlyHeader> read() {
    bool hasFormat = false;
    scan_.nextLine();  // "ply"
    for (; !scan_.atEnd(); scan_.nextLine()) {
      line_ = scan_.line();
      const std::string_view key = scan_.token();
      Result<void> done;
      if (key == "end_header") {
        scan_.nextLine();
        if (!hasFormat) return fail("the header has no format line");
        header_.bytes = static_cast<std::size_t>(scan_.position() - content_.data());
        header_.lines = line_;
        return std::move(header_);
      }
      if (key == "format") {
        done = readFormat();
        hasFormat = true;
      } else if (key == "comment") {
        done = readUnitComment(scan_.restOfLine(), name_, line_, header_.soup);
      } else if (key == "element") {
        done = readElement();
      } else if (key == "property") {
        done = readProperty();
      } else if (!key.empty() && key != "obj_info") {
        done = fail(fmt::format("{} is no PLY header line", inQuotes(key)));
      }
      if (!done) return done.error();
    }
    return fail("the header has no end");
  }

 private:
  Error fail(std::string_view what) const {
    if (scan_.atEnd()) what = "the file ends within the header; it was cut off";
    return lineError(name_, line_, what);
  }

  Result<void> readFormat() {
    const std::string_view format = scan_.token();
    if (format == "ascii") {
      header_.format = PlyFormat::Ascii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::LittleEndian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::BigEndian;
    } else {
      return fail(fmt::format("unknown format {}", inQuotes(format)));
    }
    return {};
  }

  Result<void> readElement() {
    const std::string_view element = scan_.token();
    const std::string_view number = scan_.token();
    const std::optional<std::int64_t> count = parseInteger(number);
    if (element.empty() || !count || *count < 0) {
      return fail(fmt::format("{} is no count of elements", inQuotes(number)));
    }
    if (header_.elements.size() >= kMaxElements) return fail("too many kinds of elements");
    PlyElement made;
    made.name = std::string(element);
    made.count = static_cast<std::uint64_t>(*count);
    made.line = line_;
    header_.elements.push_back(std::move(made));
    return {};
  }

  Result<void> readProperty() {
    if (header_.elements.empty()) return fail("a property before any element");
    PlyElement& element = header_.elements.back();
    if (element.properties.size() >= kMaxProperties) return fail("too many properties");
    PlyProperty property;
    std::string_view type = scan_.token();
    if (type == "list") {
      const std::string_view countType = scan_.token();
      property.countType = parseType(countType);
      if (!property.countType || !isInteger(*property.countType)) {
        return fail(fmt::format("{} is no type for the length of a list", inQuotes(countType)));
      }
      type = scan_.token();
    }
    const std::optional<PlyType> known = parseType(type);
    if (!known) return fail(fmt::format("unknown type {}", inQuotes(type)));
    property.type = *known;
    property.name = std::string(scan_.token());
    if (property.name.empty()) return fail("a property without a name");
    element.properties.push_back(std::move(property));
    return {};
  }

  std::string_view content_;
  const std::string& name_;
  TextScanner scan_;
  PlyHeader header_;
  std::uint64_t line_ = 1;
};

}  // namespace

std::size_t byteSize(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      return 8;
  }
  return 0;
}

bool isInteger(PlyType type) {
  return type != PlyType::Float32 && type != PlyType::Float64;
}

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.countType.has_value(); });
}

std::uint64_t PlyElement::leastBytes(PlyFormat format) const {
  if (format == PlyFormat::Ascii) return 2 * properties.size();  // a digit and a blank each
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += byteSize(p.countType.value_or(p.type));
  return bytes;
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return i;
  }
  return std::nullopt;
}

Result<PlyHeader> parsePlyHeader(std::string_view content, const std::string& name) {
  return HeaderReader(content, name).read();
}

}  // namespace toile::detail
