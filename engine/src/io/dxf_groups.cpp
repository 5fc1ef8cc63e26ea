// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dxf_groups.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "toile/core/units.h"

namespace toile {
namespace {

constexpr std::size_t kLongestValue = 900;  // dxflib holds 1023 bytes of a line
constexpr double kFarthest = 1e9;           // coordinates beyond are no place on a sheet

Error damaged(std::size_t line, const std::string& reason) {
  return {ErrorCode::FileFormat,
          fmt::format("line {}: {}", line, reason),
          {Element::line(static_cast<std::uint64_t>(line))}};
}

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

bool isNumberCode(int code) {
  return (code >= 10 && code <= 59) || (code >= 210 && code <= 239);
}

class Checker {
 public:
  explicit Checker(std::string_view file) : rest_(file) {}

  Result<DxfGroups> check() {
    while (true) {
      const auto codeLine = nextLine();
      if (!codeLine) {
        return damaged(line_, sawEnd_ ? "text follows the end"
                                      : "the file is cut off: it ends "
                                        "before its EOF; get it anew");
      }
      const std::string_view word = trimmed(*codeLine);
      int code = 0;
      const auto [stop, problem] = std::from_chars(word.data(), word.data() + word.size(), code);
      if (problem != std::errc() || stop != word.data() + word.size())
        return damaged(line_,
                       fmt::format("a group code is expected and \"{}\" is none", printable(word)));
      const auto value = nextLine();
      if (!value) return damaged(line_, "the file is cut off within an entity; get it anew");
      if (const auto fault = take(code, *value)) return *fault;
      if (sawEnd_) break;
    }
    closeEntity();
    return std::move(groups_);
  }

 private:
  static std::string printable(std::string_view text) {
    std::string out;
    for (const char c : text.substr(0, 30))
      out +=
          static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f ? c : '?';
    return out;
  }

  std::optional<std::string_view> nextLine() {
    if (rest_.empty()) return std::nullopt;
    ++line_;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  std::optional<Error> take(int code, std::string_view value) {
    if (code == 0) {
      closeEntity();
      entity_ = std::string(trimmed(value));
      return startEntity();
    }
    if (code == 999) return std::nullopt;
    if (code == 2 && entity_ == "SECTION") section_ = std::string(trimmed(value));
    if (isKept_ && section_ != "HEADER" && isNumberCode(code)) {
      const auto number = parseDouble(trimmed(value));
      if (!number)
        return damaged(line_,
                       fmt::format("a number is expected and \"{}\" is none", printable(value)));
      if (!(std::abs(*number) <= kFarthest))
        return damaged(line_, fmt::format("{} is no place on a sheet", printable(value)));
    }
    if (code == 90 && entity_ == "LWPOLYLINE") {
      const auto count = parseDouble(trimmed(value));
      if (!count || *count < 0 || *count > static_cast<double>(rest_.size()))
        return damaged(line_, "the number of vertices is larger than the file");
    }
    if (value.size() > kLongestValue) value = value.substr(0, kLongestValue);
    fmt::format_to(std::back_inserter(pending_), "{}\n{}\n", code, value);
    return std::nullopt;
  }

  std::optional<Error> startEntity() {
    static const std::set<std::string, std::less<>> known{
        "SECTION", "ENDSEC", "EOF",   "BLOCK",      "ENDBLK", "INSERT", "POLYLINE", "VERTEX",
        "SEQEND",  "LINE",   "POINT", "LWPOLYLINE", "ARC",    "CIRCLE", "TEXT"};
    if (entity_ == "EOF") sawEnd_ = true;
    if (isFirst_ && entity_ != "SECTION")
      return damaged(line_, "this is no DXF: it does not begin with a section");
    isFirst_ = false;
    isKept_ = known.contains(entity_);
    const bool isDrawn = section_ == "BLOCKS" || section_ == "ENTITIES";
    if (!isKept_ && isDrawn) ++groups_.leftOut[entity_];
    // The header, and what draws; tables, classes and objects are of no use here.
    const bool isFrame = entity_ == "SECTION" || entity_ == "ENDSEC" || entity_ == "EOF";
    isKept_ = isKept_ && (isFrame || isDrawn);
    return std::nullopt;
  }

  void closeEntity() {
    if (entity_.empty()) return;
    if (isKept_) {
      fmt::format_to(std::back_inserter(groups_.text), "0\n{}\n{}", entity_, pending_);
    }
    pending_.clear();
  }

  std::string_view rest_;
  std::size_t line_ = 0;
  std::string section_, entity_, pending_;
  bool isFirst_ = true, isKept_ = false, sawEnd_ = false;
  DxfGroups groups_;
};

}  // namespace

Result<DxfGroups> checkDxfGroups(std::string_view file) {
  if (file.starts_with("AutoCAD Binary DXF"))
    return damaged(1, "this is a binary DXF; save it as ASCII DXF (R12)");
  if (file.starts_with("AC10")) return damaged(1, "this is a DWG; save it as ASCII DXF (R12)");
  if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
  return Checker(file).check();
}

}  // namespace toile
