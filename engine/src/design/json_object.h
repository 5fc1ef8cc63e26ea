// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "design/json_text.h"
#include "toile/core/nearest_name.h"
#include "toile/core/units.h"
#include "toile/design/design.h"

namespace toile {

/// Keeps the first error of reading a document; later ones are its consequences.
class JsonFault {
 public:
  explicit JsonFault(std::string file) : file_(std::move(file)) {}
  void add(const JsonValue& value, const std::string& path, const std::string& what);
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  std::string file_;
  std::optional<Error> error_;
};

/// A value and where it stands: "/curves/3/way". Reads notice errors in the fault and go on with a
/// default.
struct JsonPlace {
  const JsonValue* value;
  std::string path;
  JsonFault* fault;

  void fail(const std::string& what) const { fault->add(*value, path, what); }
  [[nodiscard]] bool is(JsonValue::Kind kind) const { return value->kind == kind; }
  /// "an object", ... for messages
  bool expect(JsonValue::Kind kind, std::string_view what) const;

  [[nodiscard]] std::string string() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] double numberIn(double low, double high) const;
  /// A whole number 0..max without point or exponent.
  [[nodiscard]] std::uint32_t index(std::uint32_t max = std::numeric_limits<std::uint32_t>::max() -
                                                        1) const;
  /// Precondition: a list that has it.
  [[nodiscard]] JsonPlace item(std::size_t i) const {
    return {&value->items[i], path + "/" + std::to_string(i), fault};
  }
  [[nodiscard]] std::vector<JsonPlace> items() const;
  [[nodiscard]] std::vector<JsonPlace> items(std::size_t count) const;
  template <int Dimension>
  [[nodiscard]] Eigen::Matrix<double, Dimension, 1> vector() const {
    Eigen::Matrix<double, Dimension, 1> out = Eigen::Matrix<double, Dimension, 1>::Zero();
    const std::vector<JsonPlace> list = items(Dimension);
    for (std::size_t i = 0; i < list.size(); ++i) {
      out[static_cast<Eigen::Index>(i)] = list[i].number();
    }
    return out;
  }
  /// Text as a Length, Ratio, ...: what `parse` makes of it.
  template <class T>
  [[nodiscard]] T parsed(Result<T> (*parse)(std::string_view), T otherwise = T()) const {
    const std::string text = string();
    if (fault->error()) return otherwise;
    Result<T> result = parse(text);
    if (result) return *result;
    fail(result.error().message);
    return otherwise;
  }
  template <class Value, std::size_t Count>
  [[nodiscard]] Value oneOf(
      const std::array<std::pair<std::string_view, Value>, Count>& names) const {
    const std::string text = string();
    std::vector<std::string> known;
    for (const auto& [name, candidate] : names) {
      if (name == text) return candidate;
      known.emplace_back(name);
    }
    fail("\"" + text + "\" is not known here" + suggestion(text, known));
    return names.front().second;
  }
};

/// The members of an object: what is asked for is known, the rest is unknown.
class JsonObject {
 public:
  explicit JsonObject(const JsonPlace& place) : place_(place) {
    place.expect(JsonValue::Kind::Object, "an object { }");
  }
  [[nodiscard]] const JsonPlace& place() const { return place_; }
  [[nodiscard]] bool has(std::string_view key) const { return place_.value->find(key) != nullptr; }
  /// The member; without it an error, and the object itself.
  [[nodiscard]] JsonPlace need(std::string_view key);
  [[nodiscard]] std::optional<JsonPlace> find(std::string_view key);
  /// Text of a member, empty without it.
  [[nodiscard]] std::string text(std::string_view key);
  /// Members not asked for so far.
  [[nodiscard]] UnknownKeys unknown() const;
  void refuseUnknown() const;

 private:
  JsonPlace place_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace toile
