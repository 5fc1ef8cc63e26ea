// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/json_object.h"

#include <algorithm>
#include <charconv>

namespace toile {

void JsonFault::add(const JsonValue& value, const std::string& path, const std::string& what) {
  if (error_) return;
  error_ = Error{ErrorCode::FileFormat,
                 file_ + ", line " + std::to_string(value.line) + ", " +
                     (path.empty() ? std::string("the whole") : path) + ": " + what,
                 {Element::line(value.line)}};
}

bool JsonPlace::expect(JsonValue::Kind kind, std::string_view what) const {
  if (is(kind)) return true;
  fail("must be " + std::string(what));
  return false;
}

std::string JsonPlace::string() const {
  return expect(JsonValue::Kind::String, "a text in quotes") ? value->string : std::string();
}

bool JsonPlace::boolean() const {
  return expect(JsonValue::Kind::Bool, "true or false") && value->boolean;
}

double JsonPlace::number() const {
  return expect(JsonValue::Kind::Number, "a number") ? value->number : 0;
}

double JsonPlace::numberIn(double low, double high) const {
  const double read = number();
  if (read >= low && read <= high) return read;
  fail("must be between " + formatExact(low) + " and " + formatExact(high));
  return low;
}

std::uint32_t JsonPlace::index(std::uint32_t max) const {
  if (!expect(JsonValue::Kind::Number, "a whole number")) return 0;
  std::uint32_t read = 0;
  const char* end = value->text.data() + value->text.size();
  const auto [stop, error] = std::from_chars(value->text.data(), end, read);
  if (error != std::errc() || stop != end || read > max) {
    fail("must be a whole number from 0 to " + std::to_string(max));
    return 0;
  }
  return read;
}

std::vector<JsonPlace> JsonPlace::items() const {
  std::vector<JsonPlace> out;
  if (!expect(JsonValue::Kind::Array, "a list [ ]")) return out;
  out.reserve(value->items.size());
  for (std::size_t i = 0; i < value->items.size(); ++i) out.push_back(item(i));
  return out;
}

std::vector<JsonPlace> JsonPlace::items(std::size_t count) const {
  std::vector<JsonPlace> out = items();
  if (is(JsonValue::Kind::Array) && out.size() != count) {
    fail("must be a list of " + std::to_string(count));
    out.clear();
  }
  return out;
}

JsonPlace JsonObject::need(std::string_view key) {
  if (std::optional<JsonPlace> found = find(key)) return *found;
  std::vector<std::string> keys;
  for (const auto& [name, member] : place_.value->members) {
    if (!known_.contains(name)) keys.push_back(name);
  }
  const std::string near = nearestName(key, keys);
  place_.fail("needs the key " + quoteJson(key) +
              (near.empty() ? std::string() : "; is " + quoteJson(near) + " meant to be it?"));
  return place_;
}

std::optional<JsonPlace> JsonObject::find(std::string_view key) {
  known_.emplace(key);
  const JsonValue* member = place_.value->find(key);
  if (member == nullptr) return std::nullopt;
  return JsonPlace{member, place_.path + "/" + std::string(key), place_.fault};
}

std::string JsonObject::text(std::string_view key) {
  const std::optional<JsonPlace> found = find(key);
  return found ? found->string() : std::string();
}

UnknownKeys JsonObject::unknown() const {
  UnknownKeys out;
  for (const auto& [key, member] : place_.value->members) {
    if (!known_.contains(key)) out.emplace(key, member.text);
  }
  return out;
}

void JsonObject::refuseUnknown() const {
  for (const auto& [key, member] : place_.value->members) {
    if (!known_.contains(key)) {
      JsonPlace{&member, place_.path + "/" + key, place_.fault}.fail(
          "a model point has no such key");
    }
  }
}

}  // namespace toile
