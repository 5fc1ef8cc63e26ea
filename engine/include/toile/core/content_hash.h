// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace toile {

/// 128 bits of content (XXH3); equal content, equal hash, on every machine of one byte order.
struct ContentHash {
  std::array<std::uint64_t, 2> words{};
  friend auto operator<=>(const ContentHash&, const ContentHash&) = default;
  /// 32 lower-case hexadecimal digits.
  [[nodiscard]] std::string hex() const;
};

/// Feeds content into a ContentHash. Strings and ranges are preceded by their length, so that
/// ("ab","c") and ("a","bc") differ.
class ContentHasher {
 public:
  ContentHasher();
  ~ContentHasher();
  ContentHasher(const ContentHasher&) = delete;
  ContentHasher& operator=(const ContentHasher&) = delete;

  ContentHasher& bytes(const void* data, std::size_t size);
  ContentHasher& add(std::string_view text);
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) ContentHasher& add(T value) {
    return bytes(&value, sizeof value);
  }
  ContentHasher& add(const ContentHash& hash) { return bytes(hash.words.data(), 16); }
  [[nodiscard]] ContentHash finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile
