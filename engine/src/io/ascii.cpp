// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ascii.h"

#include <fmt/format.h>
#include <glib.h>

#include <array>
#include <memory>
#include <utility>

namespace toile {
namespace {

/// Letters that have no decomposition.
constexpr std::array<std::pair<gunichar, const char*>, 16> kSpelled{{{0xdf, "ss"},
                                                                     {0x1e9e, "SS"},
                                                                     {0xe6, "ae"},
                                                                     {0xc6, "AE"},
                                                                     {0x153, "oe"},
                                                                     {0x152, "OE"},
                                                                     {0xf8, "o"},
                                                                     {0xd8, "O"},
                                                                     {0x142, "l"},
                                                                     {0x141, "L"},
                                                                     {0x111, "d"},
                                                                     {0x110, "D"},
                                                                     {0xf0, "d"},
                                                                     {0xfe, "th"},
                                                                     {0x131, "i"},
                                                                     {0x2013, "-"}}};

struct GFree {
  void operator()(char* text) const { g_free(text); }
};
using GString = std::unique_ptr<char, GFree>;

}  // namespace

std::string toAscii(std::string_view utf8) {
  const auto size = static_cast<gssize>(utf8.size());
  const GString valid(g_utf8_make_valid(utf8.data(), size));
  const GString parts(g_utf8_normalize(valid.get(), -1, G_NORMALIZE_ALL));
  std::string ascii;
  for (const char* p = parts.get(); p != nullptr && *p != '\0'; p = g_utf8_next_char(p)) {
    const gunichar c = g_utf8_get_char(p);
    if (g_unichar_ismark(c) != 0) continue;
    if (c >= 0x20 && c < 0x7f) {
      ascii += static_cast<char>(c);
      continue;
    }
    const char* spelled = "_";
    for (const auto& [letter, text] : kSpelled)
      if (letter == c) spelled = text;
    ascii += spelled;
  }
  return ascii;
}

std::string toPlainName(std::string_view utf8, std::size_t most) {
  std::string name;
  for (char c : toAscii(utf8)) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (plain && (c != '-' || !name.empty())) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  if (name.size() > most) name.resize(most);
  while (!name.empty() && (name.back() == '_' || name.back() == '-')) name.pop_back();
  return name;
}

std::string makeUnique(const std::string& name, std::size_t most, std::set<std::string>& taken) {
  std::string unique = name;
  for (int n = 2; !taken.insert(unique).second; ++n) {
    const std::string ending = fmt::format("-{}", n);
    unique = name.substr(0, most - ending.size()) + ending;
  }
  return unique;
}

}  // namespace toile
