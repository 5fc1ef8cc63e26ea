// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/nearest_name.h"

#include <algorithm>
#include <vector>

namespace toile {
namespace {

constexpr std::size_t kMaxComparedLength = 200;
constexpr std::size_t kMaxListed = 12;

/// Optimal string alignment distance: row by row, keeping three rows of the table.
std::size_t slips(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, previous(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = previous;
    previous = row;
  }
  return previous[b.size()];
}

}  // namespace

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  if (name.size() > kMaxComparedLength) return {};
  std::size_t best = name.size() / 3 + 2;
  std::string nearest;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kMaxComparedLength) continue;
    const std::size_t distance = slips(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view name, std::span<const std::string> candidates) {
  if (candidates.empty()) return {};
  const std::string nearest = nearestName(name, candidates);
  if (!nearest.empty()) return "; did you mean \"" + nearest + "\"?";
  std::string text = "; there are: ";
  const std::size_t listed = std::min(candidates.size(), kMaxListed);
  for (std::size_t i = 0; i < listed; ++i) text += (i == 0 ? "" : ", ") + candidates[i];
  if (candidates.size() > listed) {
    text += " and " + std::to_string(candidates.size() - listed) + " more";
  }
  return text;
}

}  // namespace toile
