// SPDX-License-Identifier: GPL-3.0-or-later
// PLY in its three encodings. One record loop serves all: a Source delivers the numbers.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "mesh/ply_header.h"
#include "mesh/readers.h"
#include "mesh/text_scanner.h"

namespace toile::detail {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
T load(const char* at, bool swapped) {
  std::array<char, sizeof(T)> bytes{};
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = at[swapped ? sizeof(T) - 1 - i : i];
  return std::bit_cast<T>(bytes);
}

double loadNumber(const char* at, PlyType type, bool swapped) {
  switch (type) {
    case PlyType::Int8:
      return load<std::int8_t>(at, swapped);
    case PlyType::Uint8:
      return load<std::uint8_t>(at, swapped);
    case PlyType::Int16:
      return load<std::int16_t>(at, swapped);
    case PlyType::Uint16:
      return load<std::uint16_t>(at, swapped);
    case PlyType::Int32:
      return load<std::int32_t>(at, swapped);
    case PlyType::Uint32:
      return load<std::uint32_t>(at, swapped);
    case PlyType::Float32:
      return static_cast<double>(load<float>(at, swapped));
    case PlyType::Float64:
      return load<double>(at, swapped);
  }
  return 0;
}

/// Numbers of a binary file. Every number of a PLY type is exact in a double.
class BinarySource {
 public:
  BinarySource(std::string_view content, std::size_t begin, bool swapped)
      : content_(content), at_(begin), swapped_(swapped) {}

  [[nodiscard]] std::uint64_t bytesLeft() const { return content_.size() - at_; }
  /// Least bytes of `count` numbers.
  [[nodiscard]] static std::uint64_t leastBytes(std::uint64_t count, PlyType type) {
    return count * byteSize(type);
  }
  std::optional<double> number(PlyType type) {
    const std::size_t size = byteSize(type);
    if (bytesLeft() < size) return std::nullopt;
    const double value = loadNumber(content_.data() + at_, type, swapped_);
    at_ += size;
    return value;
  }
  bool skip(std::uint64_t count, PlyType type) {
    const std::uint64_t bytes = leastBytes(count, type);
    if (bytesLeft() < bytes) return false;
    at_ += bytes;
    return true;
  }
  [[nodiscard]] bool isAtEnd() { return bytesLeft() == 0; }
  [[nodiscard]] Error fail(const std::string& name, std::string_view what) const {
    return byteError(name, at_, what);
  }

 private:
  std::string_view content_;
  std::size_t at_;
  bool swapped_;
};

class TextSource {
 public:
  TextSource(std::string_view content, const PlyHeader& header)
      : end_(content.data() + content.size()),
        scan_(content.substr(header.bytes),
              {.comment = 0, .continued = false, .line = header.lines + 1}) {}

  /// One more than there are: the last number needs no blank behind it.
  [[nodiscard]] std::uint64_t bytesLeft() const {
    return static_cast<std::uint64_t>(end_ - scan_.position()) + 1;
  }
  [[nodiscard]] static std::uint64_t leastBytes(std::uint64_t count, PlyType) { return 2 * count; }
  std::optional<double> number(PlyType) {
    token_ = scan_.tokenOfText();
    return parseNumber(token_);
  }
  bool skip(std::uint64_t count, PlyType) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (scan_.tokenOfText().empty()) return false;
    }
    return true;
  }
  [[nodiscard]] bool isAtEnd() { return scan_.tokenOfText().empty(); }
  [[nodiscard]] Error fail(const std::string& name, std::string_view what) const {
    if (token_.empty() && scan_.atEnd()) {
      return lineError(name, scan_.line(), "the file ends too early; it was cut off");
    }
    return lineError(name, scan_.line(), fmt::format("{}, at {}", what, inQuotes(token_)));
  }

 private:
  const char* end_;
  TextScanner scan_;
  std::string_view token_;
};

template <class Source>
class RecordReader {
 public:
  RecordReader(const PlyHeader& header, Source source, const std::string& name, PolygonSoup& soup)
      : header_(header), source_(std::move(source)), name_(name), soup_(soup) {}

  Result<void> read() {
    for (const PlyElement& element : header_.elements) {
      // A count that the rest of the file has no room for is refused before anything is made.
      const std::uint64_t least = element.leastBytes(header_.format);
      if (least == 0) continue;  // no properties: no data, whatever the count
      if (element.count > source_.bytesLeft() / least) {
        return lineError(name_, element.line,
                         fmt::format("the header says {} of \"{}\", the file has no room for so "
                                     "many; it was cut off, or the header is wrong",
                                     element.count, element.name));
      }
      Result<void> done;
      if (element.name == "vertex") {
        done = readVertices(element);
      } else if (element.name == "face") {
        done = readFaces(element);
      } else if (element.name == "tristrips") {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: triangle strips are not read; save the model with plain "
                                 "faces",
                                 name_),
                     {Element::line(element.line)}};
      } else {
        for (std::uint64_t i = 0; i < element.count && done; ++i) done = skipRecord(element);
      }
      if (!done) return done;
    }
    if (!source_.isAtEnd()) {
      soup_.findings.push_back({"trailing-data",
                                fmt::format("{}: there is more in the file than its header says; "
                                            "the rest was left out",
                                            name_),
                                {}});
    }
    return checkIndices();
  }

 private:
  Error cutOff(std::string_view what, std::uint64_t record) const {
    return source_.fail(
        name_, fmt::format("{} {} cannot be read; the file was cut off or damaged", what, record));
  }

  Result<std::uint64_t> readListLength(const PlyProperty& p) {
    const std::optional<double> length = source_.number(*p.countType);
    if (!length || *length < 0 || *length != std::floor(*length) ||
        *length > static_cast<double>(source_.bytesLeft())) {
      return source_.fail(name_, fmt::format("the list \"{}\" has a wrong length; the file was "
                                             "cut off or damaged",
                                             p.name));
    }
    const auto count = static_cast<std::uint64_t>(*length);
    if (Source::leastBytes(count, p.type) > source_.bytesLeft()) {
      return source_.fail(name_, fmt::format("the list \"{}\" goes past the end; the file was cut "
                                             "off or damaged",
                                             p.name));
    }
    return count;
  }

  Result<void> skipProperty(const PlyProperty& p) {
    std::uint64_t count = 1;
    if (p.countType) {
      const Result<std::uint64_t> length = readListLength(p);
      if (!length) return length.error();
      count = *length;
    }
    if (!source_.skip(count, p.type)) {
      return source_.fail(name_, fmt::format("the property \"{}\" cannot be read; the file was "
                                             "cut off",
                                             p.name));
    }
    return {};
  }

  Result<void> skipRecord(const PlyElement& element) {
    for (const PlyProperty& p : element.properties) {
      if (Result<void> done = skipProperty(p); !done) return done;
    }
    return {};
  }

  Result<void> readVertices(const PlyElement& element) {
    std::vector<int> axisOf(element.properties.size(), -1);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = std::array{"x", "y", "z"}[static_cast<std::size_t>(axis)];
      const std::optional<std::size_t> at = element.find(word);
      if (!at || element.properties[*at].countType) {
        return lineError(name_, element.line, fmt::format("vertices have no {}", inQuotes(word)));
      }
      axisOf[*at] = axis;
    }
    if (element.count > kMaxVertices) return lineError(name_, element.line, "too many vertices");
    soup_.positions.reserve(soup_.positions.size() + element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Eigen::Vector3d position = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        if (axisOf[k] < 0) {
          if (Result<void> done = skipProperty(p); !done) return done;
          continue;
        }
        const std::optional<double> value = source_.number(p.type);
        if (!value) return cutOff("vertex", i);
        if (!std::isfinite(*value)) {
          return source_.fail(name_,
                              fmt::format("vertex {}: \"{}\" is not a finite number", i, p.name));
        }
        position[axisOf[k]] = *value;
      }
      soup_.positions.push_back(position);
    }
    return {};
  }

  Result<void> readFaces(const PlyElement& element) {
    std::optional<std::size_t> at = element.find("vertex_indices");
    if (!at) at = element.find("vertex_index");
    if (!at || !element.properties[*at].countType || !isInteger(element.properties[*at].type)) {
      return lineError(name_, element.line, "faces have no list \"vertex_indices\"");
    }
    if (element.count > kMaxPolygons) return lineError(name_, element.line, "too many faces");
    soup_.polygons.reserve(soup_.polygons.size() + element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        Result<void> done = k == *at ? readFace(p, i) : skipProperty(p);
        if (!done) return done;
      }
    }
    return {};
  }

  Result<void> readFace(const PlyProperty& p, std::uint64_t face) {
    const Result<std::uint64_t> length = readListLength(p);
    if (!length) return length.error();
    std::vector<std::uint32_t> corners(*length);
    for (std::uint32_t& corner : corners) {
      const std::optional<double> index = source_.number(p.type);
      if (!index) return cutOff("face", face);
      if (*index < 0 || *index > static_cast<double>(kMaxVertices) ||
          *index != std::floor(*index)) {
        return source_.fail(name_, fmt::format("face {} has the vertex number {}", face, *index));
      }
      corner = static_cast<std::uint32_t>(*index);
    }
    soup_.polygons.push_back(std::move(corners));
    return {};
  }

  /// At the end, for the vertices may stand behind the faces.
  Result<void> checkIndices() const {
    for (std::size_t f = 0; f < soup_.polygons.size(); ++f) {
      for (const std::uint32_t v : soup_.polygons[f]) {
        if (v < soup_.positions.size()) continue;
        return Error{ErrorCode::FileFormat,
                     fmt::format("{}: face {} (counted from 0) has the vertex number {}, and there "
                                 "are {} vertices",
                                 name_, f, v, soup_.positions.size()),
                     {Element::face(FaceId(f))}};
      }
    }
    return {};
  }

  const PlyHeader& header_;
  Source source_;
  const std::string& name_;
  PolygonSoup& soup_;
};

}  // namespace

bool looksLikePly(std::string_view content) {
  return content.starts_with("ply\n") || content.starts_with("ply\r");
}

Result<PolygonSoup> parsePly(std::string_view content, const std::string& name) {
  Result<PlyHeader> header = parsePlyHeader(content, name);
  if (!header) return header.error();
  PolygonSoup soup = std::move(header->soup);
  Result<void> done;
  if (header->format == PlyFormat::Ascii) {
    done = RecordReader(*header, TextSource(content, *header), name, soup).read();
  } else {
    const bool swapped = header->format == PlyFormat::BigEndian;
    done = RecordReader(*header, BinarySource(content, header->bytes, swapped), name, soup).read();
  }
  if (!done) return done.error();
  if (soup.positions.empty()) {
    return Error{ErrorCode::FileFormat, fmt::format("{}: the file has no vertices", name), {}};
  }
  return soup;
}

}  // namespace toile::detail
