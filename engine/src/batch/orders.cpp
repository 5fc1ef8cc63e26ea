// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies a batch is made for.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "toile/batch/batch.h"
#include "toile/core/file.h"
#include "toile/core/nearest_name.h"
#include "toile/shape/builtin.h"

namespace toile {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOrders = 100'000;
constexpr std::size_t kMostListBytes = std::size_t{64} << 20;
const std::array<std::string, 6> kColumns = {"body", "name",  "customer",
                                             "size", "units", "landmarks"};

/// A name that is a folder on every file system.
std::string folderName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool isBad =
        byte < 32 || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
    name += isBad ? '-' : c;
  }
  while (!name.empty() && (name.back() == '.' || name.back() == ' ')) name.pop_back();
  while (!name.empty() && name.front() == '.') name.erase(name.begin());
  if (name.size() > 100) name.resize(100);
  return name.empty() ? "order" : name;
}

void makeUnique(std::vector<BatchOrder>& orders) {
  std::set<std::string> taken;
  for (BatchOrder& order : orders) {
    const std::string wanted = folderName(order.name);
    order.name = wanted;
    for (int n = 2; !taken.insert(order.name).second; ++n) {
      order.name = fmt::format("{}-{}", wanted, n);
    }
  }
}

bool isBodyFile(const fs::path& path) {
  const std::string name = path.filename().string();
  if (name.starts_with(".")) return false;
  if (name.ends_with(".model.json")) return true;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension == ".ply" || extension == ".obj" || extension == ".stl" || extension == ".off";
}

Result<std::vector<BatchOrder>> ordersInFolder(const fs::path& folder,
                                               std::optional<FileUnit> unit) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    std::error_code ignored;
    if (entry.is_regular_file(ignored) && isBodyFile(entry.path())) files.push_back(entry.path());
  }
  if (failed) {
    return Error{ErrorCode::FileUnreadable,
                 fmt::format("cannot read the folder {}: {}", folder.string(), failed.message()),
                 {}};
  }
  // A model file stands for its mesh.
  std::set<std::string> models;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (name.ends_with(".model.json")) models.insert(name.substr(0, name.size() - 11));
  }
  std::sort(files.begin(), files.end());
  std::vector<BatchOrder> orders;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const bool isModel = name.ends_with(".model.json");
    const std::string stem = isModel ? name.substr(0, name.size() - 11) : file.stem().string();
    if (!isModel && models.contains(stem)) continue;
    BatchOrder order;
    order.name = stem;
    order.body = file.string();
    order.unit = unit;
    order.customer = stem;
    orders.push_back(std::move(order));
  }
  if (orders.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{} holds no bodies (*.ply, *.obj, *.stl, *.off, *.model.json)",
                             folder.string()),
                 {}};
  }
  return orders;
}

/// The cells of a line; quoted cells may hold commas, doubled quotes are one.
std::optional<std::vector<std::string>> cellsOf(std::string_view line) {
  std::vector<std::string> cells(1);
  bool isQuoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (isQuoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"') {
      isQuoted = !isQuoted;
    } else if (c == ',' && !isQuoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  if (isQuoted) return std::nullopt;
  for (std::string& cell : cells) {
    const auto first = cell.find_first_not_of(" \t");
    const auto last = cell.find_last_not_of(" \t");
    cell = first == std::string::npos ? "" : cell.substr(first, last - first + 1);
  }
  return cells;
}

BatchOrder readRow(const std::vector<std::string>& columns, std::string_view line,
                   std::size_t number, const fs::path& folder, std::optional<FileUnit> unit) {
  BatchOrder order;
  order.unit = unit;
  order.name = fmt::format("line-{}", number);
  const auto cells = cellsOf(line);
  if (!cells) {
    order.refusal = fmt::format("line {}: a quote is not closed", number);
    return order;
  }
  if (cells->size() != columns.size()) {
    order.refusal = fmt::format("line {}: {} cells, but the first line names {}", number,
                                cells->size(), columns.size());
    return order;
  }
  std::string name;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& cell = (*cells)[i];
    if (cell.empty()) continue;
    if (columns[i] == "body") order.body = cell;
    if (columns[i] == "name") name = cell;
    if (columns[i] == "customer") order.customer = cell;
    if (columns[i] == "size") order.size = cell;
    if (columns[i] == "landmarks") order.landmarks = folder / cell;
    if (columns[i] == "units") {
      const Result<FileUnit> parsed = parseFileUnit(cell);
      if (!parsed) {
        order.refusal = fmt::format("line {}: {}", number, parsed.error().message);
      } else {
        order.unit = *parsed;
      }
    }
  }
  if (order.body.empty()) {
    order.refusal = fmt::format("line {}: it names no body", number);
    return order;
  }
  const fs::path body(order.body);
  if (name.empty()) name = isBuiltin(order.body) ? order.name : body.stem().string();
  order.name = name;
  if (order.customer.empty()) order.customer = name;
  if (!isBuiltin(order.body) && !body.is_absolute()) order.body = (folder / body).string();
  return order;
}

Result<std::vector<BatchOrder>> ordersInList(const fs::path& list, std::optional<FileUnit> unit) {
  const Result<std::string> text = readFile(list, kMostListBytes);
  if (!text) return text.error();
  std::string_view rest = *text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  std::vector<std::string> columns;
  std::vector<BatchOrder> orders;
  std::size_t number = 0;
  const auto refuse = [&](const std::string& why) {
    return Error{ErrorCode::FileFormat,
                 fmt::format("{}, line {}: {}", list.string(), number, why),
                 {Element::line(number)}};
  };
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++number;
    if (line.find_first_not_of(" \t\r,") == std::string_view::npos) continue;
    if (columns.empty()) {
      columns = cellsOf(line).value_or(std::vector<std::string>{});
      const std::vector<std::string> known(kColumns.begin(), kColumns.end());
      for (const std::string& column : columns) {
        if (std::find(known.begin(), known.end(), column) != known.end()) continue;
        return refuse("there is no column \"" + column + "\"" + suggestion(column, known));
      }
      if (std::count(columns.begin(), columns.end(), "body") != 1) {
        return refuse("the first line must name the columns, one of them \"body\"");
      }
      continue;
    }
    orders.push_back(readRow(columns, line, number, list.parent_path(), unit));
    if (orders.size() > kMostOrders) return refuse(fmt::format("more than {} orders", kMostOrders));
  }
  if (orders.empty()) return refuse("the list holds no order");
  return orders;
}

}  // namespace

Result<std::vector<BatchOrder>> readOrders(const fs::path& bodies, std::optional<FileUnit> unit) {
  std::error_code ignored;
  Result<std::vector<BatchOrder>> orders =
      fs::is_directory(bodies, ignored) ? ordersInFolder(bodies, unit) : ordersInList(bodies, unit);
  if (orders) makeUnique(*orders);
  return orders;
}

}  // namespace toile
