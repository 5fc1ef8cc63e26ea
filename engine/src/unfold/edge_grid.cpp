// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/edge_grid.h"

#include <algorithm>
#include <cmath>

namespace toile::unfolding {

std::vector<std::pair<std::uint32_t, std::uint32_t>> nearSegments(
    const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& segments, double margin) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  if (segments.empty()) return found;
  Eigen::Vector2d low = segments.front().first;
  Eigen::Vector2d high = low;
  double longest = 0;
  for (const auto& [a, b] : segments) {
    low = low.cwiseMin(a).cwiseMin(b);
    high = high.cwiseMax(a).cwiseMax(b);
    longest = std::max(longest, (a - b).norm());
  }
  const Eigen::Vector2d wider = Eigen::Vector2d::Constant(margin);
  low -= wider;
  high += wider;
  // Cells of about a segment; no more of them than a few per segment, however long the piece is.
  const double extent = (high - low).maxCoeff();
  const double count = static_cast<double>(segments.size());
  const double cell = std::max({extent / (1.0 + 4.0 * std::sqrt(count)), 0.25 * longest, 1e-300});
  const std::int64_t columns = static_cast<std::int64_t>((high.x() - low.x()) / cell) + 1;
  std::vector<std::pair<std::int64_t, std::uint32_t>> entries;  // cell, segment
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    const auto& [a, b] = segments[i];
    const Eigen::Vector2d from = (a.cwiseMin(b) - wider - low) / cell;
    const Eigen::Vector2d to = (a.cwiseMax(b) + wider - low) / cell;
    for (auto y = static_cast<std::int64_t>(from.y()); y <= static_cast<std::int64_t>(to.y());
         ++y) {
      for (auto x = static_cast<std::int64_t>(from.x()); x <= static_cast<std::int64_t>(to.x());
           ++x) {
        entries.emplace_back(y * columns + x, i);
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].first == entries[begin].first) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        if (entries[i].second == entries[j].second) continue;
        found.push_back(std::minmax(entries[i].second, entries[j].second));
      }
    }
    begin = end;
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace toile::unfolding
