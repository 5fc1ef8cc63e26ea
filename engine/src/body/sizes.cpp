// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "toile/core/nearest_name.h"

namespace toile {
namespace {

struct Row {
  int number;
  double height, chest, waist, hip;  ///< cm
};

constexpr std::array<Row, 12> kWomen{{
    {32, 168, 76, 60, 84},
    {34, 168, 80, 64, 88},
    {36, 168, 84, 68, 92},
    {38, 168, 88, 72, 96},
    {40, 168, 92, 76, 100},
    {42, 168, 96, 80, 104},
    {44, 168, 100, 84, 108},
    {46, 168, 104, 88, 112},
    {48, 168, 110, 94, 117},
    {50, 168, 116, 100, 122},
    {52, 168, 122, 106, 127},
    {54, 168, 128, 112, 132},
}};
constexpr std::array<Row, 10> kMen{{
    {44, 168, 88, 76, 94},
    {46, 171, 92, 80, 97},
    {48, 174, 96, 84, 100},
    {50, 177, 100, 88, 103},
    {52, 180, 104, 92, 106},
    {54, 182, 108, 96, 110},
    {56, 184, 112, 100, 114},
    {58, 186, 116, 104, 118},
    {60, 187, 120, 109, 122},
    {62, 188, 124, 114, 126},
}};
constexpr std::array<Row, 11> kChildren{{
    {104, 104, 56, 53, 60},
    {110, 110, 57, 54, 62},
    {116, 116, 59, 55, 64},
    {122, 122, 62, 57, 66},
    {128, 128, 64, 58, 69},
    {134, 134, 67, 60, 72},
    {140, 140, 70, 62, 75},
    {146, 146, 74, 64, 79},
    {152, 152, 77, 66, 82},
    {158, 158, 80, 68, 86},
    {164, 164, 83, 70, 89},
}};

void append(std::vector<BodySize>& sizes, std::span<const Row> rows, char group, double masculine) {
  for (const Row& row : rows) {
    BodySize size;
    size.name = fmt::format("EU{}{}", row.number, group);
    size.options.masculine = masculine;
    size.options.measures = {{BodyMeasure::Height, Length::cm(row.height)},
                             {BodyMeasure::Chest, Length::cm(row.chest)},
                             {BodyMeasure::Waist, Length::cm(row.waist)},
                             {BodyMeasure::Hip, Length::cm(row.hip)}};
    sizes.push_back(std::move(size));
  }
}

Error refusal(const std::string& file, std::size_t line, const std::string& what) {
  return {ErrorCode::FileFormat, fmt::format("{}, line {}: {}", file, line, what), {}};
}

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> out;
  while (true) {
    const std::size_t end = line.find(',');
    std::string_view cell = line.substr(0, end);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r')) {
      cell.remove_suffix(1);
    }
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
    out.emplace_back(cell);
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

const std::vector<BodySize>& standardSizes() {
  static const std::vector<BodySize> sizes = [] {
    std::vector<BodySize> all;
    append(all, kWomen, 'F', 0);
    append(all, kMen, 'M', 1);
    append(all, kChildren, 'C', 0.5);
    return all;
  }();
  return sizes;
}

Result<BodySize> findSize(const std::vector<BodySize>& sizes, std::string_view name) {
  std::vector<std::string> names;
  for (const BodySize& size : sizes) {
    if (size.name == name) return size;
    names.push_back(size.name);
  }
  return Error{
      ErrorCode::NameNotFound,
      "there is no size \"" + std::string(name) + "\"" + suggestion(std::string(name), names),
      {}};
}

Result<std::vector<BodySize>> parseSizeTable(std::string_view csv, const std::string& file,
                                             std::optional<FileUnit> unit) {
  constexpr std::size_t kMostLines = 1000;
  std::vector<std::string> columns;
  std::vector<BodySize> sizes;
  std::size_t number = 0;
  if (csv.starts_with("\xEF\xBB\xBF")) csv.remove_prefix(3);
  while (!csv.empty()) {
    const std::size_t end = std::min(csv.find('\n'), csv.size());
    const std::string_view line = csv.substr(0, end);
    csv.remove_prefix(std::min(end + 1, csv.size()));
    ++number;
    if (number > kMostLines) {
      return refusal(file, number, fmt::format("more than {} lines", kMostLines));
    }
    if (line.find_first_not_of(" \t\r,") == std::string_view::npos) continue;
    const std::vector<std::string> row = cells(line);
    if (columns.empty()) {
      columns = row;
      const std::vector<std::string> known = bodyOptionNames();
      for (const std::string& name : columns) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
          return refusal(file, number,
                         "there is no column \"" + name + "\"" + suggestion(name, known));
        }
      }
      if (std::count(columns.begin(), columns.end(), "size") != 1) {
        return refusal(file, number, "the first line must name the columns, one of them \"size\"");
      }
      continue;
    }
    if (row.size() != columns.size()) {
      return refusal(
          file, number,
          fmt::format("{} cells, but the first line names {}", row.size(), columns.size()));
    }
    BodySize size;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i].empty()) continue;
      if (columns[i] == "size") {
        size.name = row[i];
        continue;
      }
      std::string text = row[i];
      const auto isMeasure = [&](const BodyMeasureInfo& info) { return info.name == columns[i]; };
      if (unit && parseDouble(text) &&
          std::any_of(bodyMeasures().begin(), bodyMeasures().end(), isMeasure)) {
        text += toString(*unit);
      }
      const Result<void> set = setBodyOption(size.options, columns[i], text);
      if (!set) return refusal(file, number, set.error().message);
    }
    const auto isSame = [&](const BodySize& other) { return other.name == size.name; };
    if (size.name.empty()) return refusal(file, number, "the size has no name");
    if (std::any_of(sizes.begin(), sizes.end(), isSame)) {
      return refusal(file, number, "size \"" + size.name + "\" stands twice");
    }
    sizes.push_back(std::move(size));
  }
  if (sizes.empty()) return refusal(file, number, "the table holds no size");
  return sizes;
}

}  // namespace toile
