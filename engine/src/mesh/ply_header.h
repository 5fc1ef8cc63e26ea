// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/mesh/mesh_file.h"

namespace toile::detail {

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
enum class PlyFormat { Ascii, LittleEndian, BigEndian };

[[nodiscard]] std::size_t byteSize(PlyType type);
[[nodiscard]] bool isInteger(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> countType;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::uint64_t line = 0;  ///< of the header
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool hasLists() const;
  /// Bytes of one record when every list in it is empty; of the text, for ascii.
  [[nodiscard]] std::uint64_t leastBytes(PlyFormat format) const;
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;    ///< where the data begin
  std::uint64_t lines = 0;  ///< of the header
  PolygonSoup soup;         ///< with the unit, otherwise empty
};

Result<PlyHeader> parsePlyHeader(std::string_view content, const std::string& name);

}  // namespace toile::detail
