// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/over_bracing.h"

#include <algorithm>

namespace toile::unfolding {
namespace {

/// Work beyond this ends the search: what was found until then is enough to name.
constexpr std::size_t kMaxFound = 64;

/// Every joint has two pebbles. A bar that is independent of those before it is covered by a pebble
/// of one of its joints, the owner; pebbles are freed by letting the other joint cover.
class PebbleGame {
 public:
  PebbleGame(std::size_t joints, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bars)
      : bars_(bars), covered_(joints), free_(joints, 2), seen_(joints, 0), by_(joints, 0) {}

  /// True if the bar is independent of those accepted.
  bool accept(std::uint32_t bar) {
    const auto [a, b] = bars_[bar];
    while (free_[a] < 2 && gather(a, b)) {
    }
    while (free_[b] < 2 && gather(b, a)) {
    }
    if (free_[a] + free_[b] < 4) return false;
    --free_[a];
    covered_[a].push_back(bar);
    return true;
  }

  /// After accept(bar) was false: the accepted bars of the rigid part that holds both its ends.
  std::vector<std::uint32_t> rigidPart(std::uint32_t bar) {
    // The failed search for a fourth pebble closed off a part that has only the three of a rigid
    // body: what it covers is rigid without the bar.
    const auto [a, b] = bars_[bar];
    (void)reach(b, a);
    std::vector<std::uint32_t> inside;
    for (std::uint32_t joint = 0; joint < seen_.size(); ++joint) {
      if (seen_[joint] == stamp_)
        inside.insert(inside.end(), covered_[joint].begin(), covered_[joint].end());
    }
    std::sort(inside.begin(), inside.end());
    return inside;
  }

 private:
  /// Frees one more pebble at `joint` without taking one from `keep`.
  bool gather(std::uint32_t joint, std::uint32_t keep) {
    const std::uint32_t source = reach(joint, keep);
    if (source == kNone) return false;
    // Along the way back every bar passes to the joint from which it was entered.
    --free_[source];
    for (std::uint32_t at = source; at != joint;) {
      const std::uint32_t bar = by_[at];
      const std::uint32_t owner = bars_[bar].first == at ? bars_[bar].second : bars_[bar].first;
      auto& list = covered_[owner];
      list.erase(std::find(list.begin(), list.end(), bar));
      covered_[at].push_back(bar);
      at = owner;
    }
    ++free_[joint];
    return true;
  }

  /// Searches the joints behind the bars that `joint` covers for a free pebble; `keep` has none to
  /// give but is searched through.
  std::uint32_t reach(std::uint32_t joint, std::uint32_t keep) {
    ++stamp_;
    stack_.assign(1, joint);
    seen_[joint] = stamp_;
    while (!stack_.empty()) {
      const std::uint32_t at = stack_.back();
      stack_.pop_back();
      for (const std::uint32_t bar : covered_[at]) {
        const std::uint32_t other = bars_[bar].first == at ? bars_[bar].second : bars_[bar].first;
        if (seen_[other] == stamp_) continue;
        seen_[other] = stamp_;
        by_[other] = bar;
        if (other != keep && free_[other] > 0) return other;
        stack_.push_back(other);
      }
    }
    return kNone;
  }

  static constexpr std::uint32_t kNone = 0xffffffffU;
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bars_;
  std::vector<std::vector<std::uint32_t>> covered_;
  std::vector<int> free_;
  std::vector<std::uint32_t> seen_, by_, stack_;
  std::uint32_t stamp_ = 0;
};

/// A joint with two bars or fewer braces nothing: takes such joints away until none is left.
std::vector<std::uint32_t> barsBetweenBusyJoints(
    std::size_t jointCount, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bars) {
  std::vector<std::vector<std::uint32_t>> at(jointCount);
  for (std::uint32_t i = 0; i < bars.size(); ++i) {
    at[bars[i].first].push_back(i);
    at[bars[i].second].push_back(i);
  }
  std::vector<std::size_t> degree(jointCount);
  std::vector<char> gone(bars.size(), 0);
  std::vector<std::uint32_t> idle;
  for (std::uint32_t j = 0; j < jointCount; ++j) {
    degree[j] = at[j].size();
    if (degree[j] <= 2) idle.push_back(j);
  }
  while (!idle.empty()) {
    const std::uint32_t joint = idle.back();
    idle.pop_back();
    for (const std::uint32_t bar : at[joint]) {
      if (gone[bar] != 0) continue;
      gone[bar] = 1;
      --degree[joint];
      const std::uint32_t other = bars[bar].first == joint ? bars[bar].second : bars[bar].first;
      if (--degree[other] == 2) idle.push_back(other);
    }
  }
  std::vector<std::uint32_t> left;
  for (std::uint32_t i = 0; i < bars.size(); ++i) {
    if (gone[i] == 0) left.push_back(i);
  }
  return left;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> findOverBraced(
    std::size_t jointCount, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bars) {
  std::vector<std::vector<std::uint32_t>> found;
  const std::vector<std::uint32_t> busy = barsBetweenBusyJoints(jointCount, bars);
  if (busy.empty()) return found;
  PebbleGame game(jointCount, bars);
  for (const std::uint32_t bar : busy) {
    if (game.accept(bar)) continue;
    // The rigid part around the bar, then thinned: joints with two bars of it brace nothing.
    std::vector<std::uint32_t> part = game.rigidPart(bar);
    part.insert(std::lower_bound(part.begin(), part.end(), bar), bar);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> partBars;
    for (const std::uint32_t i : part) partBars.push_back(bars[i]);
    std::vector<std::uint32_t> thinned;
    for (const std::uint32_t i : barsBetweenBusyJoints(jointCount, partBars)) {
      thinned.push_back(part[i]);
    }
    found.push_back(std::move(thinned));
    if (found.size() == kMaxFound) break;
  }
  return found;
}

}  // namespace toile::unfolding
