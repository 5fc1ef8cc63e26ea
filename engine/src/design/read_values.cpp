// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/read_values.h"

#include <algorithm>

#include "toile/design/finish_limits.h"

namespace toile::detail {

std::string readId(const JsonPlace& at) {
  const std::string id = at.string();
  const auto isAllowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (id.empty() || !std::all_of(id.begin(), id.end(), isAllowed)) {
    at.fail("an id is made of letters a-z A-Z, digits, \"_\" and \"-\"");
  }
  return id;
}

std::string readName(const JsonPlace& at) {
  std::string name = at.string();
  if (name.empty()) at.fail("must not be empty");
  return name;
}

Length readLength(const JsonPlace& at) {
  return at.parsed(parseLength);
}

Length readLengthFrom(const JsonPlace& at, Length least, bool orEqual) {
  const Length length = readLength(at);
  if (length < least || (!orEqual && length == least)) {
    at.fail(std::string("must ") + (orEqual ? "not be below " : "be above ") + toString(least));
  }
  return length;
}

Length readLengthIn(const JsonPlace& at, Length low, Length high) {
  const Length length = readLength(at);
  if (length < low || length > high) {
    at.fail("must be between " + toString(low) + " and " + toString(high));
  }
  return length;
}

Length readAllowance(const JsonPlace& at) {
  return readLengthIn(at, Length(), kMostAllowance);
}

Ratio readRatio(const JsonPlace& at, double low, double high) {
  const Ratio ratio = at.parsed(parseRatio, Ratio::of(low));
  if (ratio.value() < low || ratio.value() > high) {
    at.fail("must be between " + toString(Ratio::of(low)) + " and " + toString(Ratio::of(high)));
  }
  return ratio;
}

Eigen::Vector3d readDirection(const JsonPlace& at) {
  const Eigen::Vector3d direction = at.vector<3>();
  if (direction.isZero(0)) at.fail("a direction must not be zero");
  return direction;
}

ContentHash readHash(const JsonPlace& at) {
  const std::string text = at.string();
  ContentHash hash;
  const auto digit = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (text.size() != 32 ||
      !std::all_of(text.begin(), text.end(), [&](char c) { return digit(c) >= 0; })) {
    at.fail("must be 32 hexadecimal digits");
    return hash;
  }
  for (std::size_t i = 0; i < 32; ++i) {
    std::uint64_t& word = hash.words[i / 16];
    word = (word << 4) | static_cast<std::uint64_t>(digit(text[i]));
  }
  return hash;
}

}  // namespace toile::detail
