// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "toile/core/result.h"

namespace toile {

struct JsonMember;

/// A JSON value that remembers where in the text it stands. Why not nlohmann::json: it keeps
/// neither the line of a value nor its text, which errors and unknown keys need.
struct JsonValue {
  enum class Kind { Null, Bool, Number, String, Array, Object };
  Kind kind = Kind::Null;
  bool boolean = false;
  double number = 0;
  std::string string;
  std::vector<JsonValue> items;
  std::vector<JsonMember> members;  ///< in the order of the text
  std::string_view text;            ///< the value's part of the text
  std::size_t line = 1;             ///< where it begins

  [[nodiscard]] const JsonValue* find(std::string_view key) const;
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

struct JsonLimits {
  std::size_t bytes = std::size_t{32} << 20;
  std::size_t values = 4'000'000;
  int depth = 64;
};

/// Strict RFC 8259: valid UTF-8, no repeated keys, finite numbers, nothing after the value.
/// The result refers to `text`. @return FileFormat with the file, line and column otherwise.
Result<JsonValue> parseJson(std::string_view text, const std::string& file,
                            const JsonLimits& limits = {});

/// A JSON string with its quotes.
std::string quoteJson(std::string_view text);

}  // namespace toile
