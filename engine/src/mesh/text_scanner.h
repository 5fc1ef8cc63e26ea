// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace toile::detail {

/// Walks through text token by token and knows the line it is in. Lines end with LF, CR LF or CR.
/// Copies nothing; every step is O(token).
class TextScanner {
 public:
  struct Style {
    char comment = '#';      ///< from here to the end of the line; 0 = no comments
    bool continued = false;  ///< a backslash at the end of a line joins the next one to it
    std::uint64_t line = 1;  ///< number of the first line
  };
  TextScanner(std::string_view text, const Style& style)
      : at_(text.data()), end_(text.data() + text.size()), style_(style), line_(style.line) {}

  [[nodiscard]] bool atEnd() const { return at_ == end_; }
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] const char* position() const { return at_; }

  /// The next token of this line; empty at its end, which is not passed.
  std::string_view token() {
    skipBlanks();
    const char* begin = at_;
    while (at_ != end_ && !isBlank(*at_) && !isLineEnd(*at_) && !isComment(*at_) &&
           !(*at_ == '\\' && continuationLength() != 0)) {
      ++at_;
    }
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }
  /// The next token, in whatever line it is; empty at the end of the text.
  std::string_view tokenOfText() {
    for (;;) {
      const std::string_view found = token();
      if (!found.empty() || at_ == end_) return found;
      nextLine();
    }
  }
  /// What is left of this line, comments included, without blanks around it.
  std::string_view restOfLine() {
    while (at_ != end_ && isBlank(*at_)) ++at_;
    const char* begin = at_;
    while (at_ != end_ && !isLineEnd(*at_)) ++at_;
    const char* last = at_;
    while (last != begin && isBlank(last[-1])) --last;
    return {begin, static_cast<std::size_t>(last - begin)};
  }
  /// True at a comment; then restOfLine() is it.
  [[nodiscard]] bool atComment() {
    skipBlanks();
    return at_ != end_ && isComment(*at_);
  }
  /// Behind the end of this line.
  void nextLine() {
    while (at_ != end_ && !isLineEnd(*at_)) ++at_;
    passLineEnd();
  }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool isLineEnd(char c) { return c == '\n' || c == '\r'; }
  [[nodiscard]] bool isComment(char c) const { return c == style_.comment && c != 0; }

  /// Length of a backslash and the line end behind it; 0 if this is none.
  [[nodiscard]] std::size_t continuationLength() const {
    if (!style_.continued || end_ - at_ < 2 || !isLineEnd(at_[1])) return 0;
    return at_[1] == '\r' && end_ - at_ > 2 && at_[2] == '\n' ? 3 : 2;
  }
  void skipBlanks() {
    while (at_ != end_) {
      if (isBlank(*at_)) {
        ++at_;
      } else if (*at_ == '\\' && continuationLength() != 0) {
        at_ += continuationLength();
        ++line_;
      } else {
        return;
      }
    }
  }
  void passLineEnd() {
    if (at_ == end_) return;
    if (*at_ == '\r' && end_ - at_ > 1 && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
  }

  const char* at_;
  const char* end_;
  Style style_;
  std::uint64_t line_;
};

/// The whole token as a finite number; nullopt for anything else (words, "nan", overflow, a comma).
/// What is too small for a double is zero.
inline std::optional<double> parseNumber(std::string_view token) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  double value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, status] = std::from_chars(token.data(), end, value);
  if (stop != end || token.empty()) return std::nullopt;
  if (status == std::errc::result_out_of_range &&
      (token.find("e-") != token.npos || token.find("E-") != token.npos)) {
    return 0.0;
  }
  if (status != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The whole token as an integer.
inline std::optional<std::int64_t> parseInteger(std::string_view token) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  std::int64_t value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, status] = std::from_chars(token.data(), end, value);
  if (status != std::errc() || stop != end || token.empty()) return std::nullopt;
  return value;
}

}  // namespace toile::detail
