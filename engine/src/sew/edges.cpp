// SPDX-License-Identifier: GPL-3.0-or-later
#include "sew/edges.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "toile/sew/sewing.h"

namespace toile {

std::vector<std::vector<std::uint32_t>> edgeGroups(const PatternPiece& piece) {
  std::vector<std::vector<std::uint32_t>> groups;
  const auto goesOn = [&](const OutlineRun& before, const OutlineRun& run) {
    return before.loop == run.loop && before.curve == run.curve && before.seam == run.seam &&
           !piece.sewLines[run.loop][run.first].corner;
  };
  for (std::size_t first = 0; first < piece.runs.size();) {
    std::size_t end = first;
    while (end < piece.runs.size() && piece.runs[end].loop == piece.runs[first].loop) ++end;
    const std::size_t begun = groups.size();
    for (std::size_t r = first; r < end; ++r) {
      if (r == first || !goesOn(piece.runs[r - 1], piece.runs[r])) groups.emplace_back();
      groups.back().push_back(static_cast<std::uint32_t>(r));
    }
    // The loop may begin in the middle of an edge.
    if (groups.size() > begun + 1 && goesOn(piece.runs[end - 1], piece.runs[first])) {
      std::vector<std::uint32_t>& last = groups.back();
      last.insert(last.end(), groups[begun].begin(), groups[begun].end());
      groups[begun] = std::move(last);
      groups.pop_back();
    }
    first = end;
  }
  return groups;
}

double drawnLength(const PatternPiece& piece, const OutlineRun& run) {
  const Outline& loop = piece.sewLines[run.loop];
  double length = 0;
  for (std::size_t k = 0; k < run.edgeCount; ++k)
    length += (loop[(run.first + k + 1) % loop.size()].position -
               loop[(run.first + k) % loop.size()].position)
                  .norm();
  return length;
}

double total(const std::vector<double>& lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

double shareOf(const OutlineRun& run, const Wire& wire) {
  const double target = total(wire.targetLength);
  constexpr double kWhole = 1e-6;  // flat lengths are within 1e-9 of their targets
  return target <= 0 || std::abs(run.length - target) <= kWhole * target ? 1 : run.length / target;
}

std::string seamLetters(int seam) {
  std::string letters;
  for (int n = seam; n > 0; n = (n - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (n - 1) % 26));
  return letters;
}

std::string edgeCodes(const Pattern& pattern, const PatternPiece& piece, const OutlineRun& run) {
  if (run.seam == 0) return {};
  const std::string letters = seamLetters(run.seam);
  if (run.mate != piece.id) {
    for (const PatternPiece& other : pattern.pieces)
      if (other.id == run.mate)
        return fmt::format("{}{}-{}{}", piece.number, letters, other.number, letters);
    return fmt::format("{}{}", piece.number, letters);
  }
  // Both sides are of this piece: the first of them is "a".
  int side = 0;
  for (const std::vector<std::uint32_t>& group : edgeGroups(piece)) {
    if (piece.runs[group.front()].seam != run.seam) continue;
    for (const std::uint32_t r : group)
      if (&piece.runs[r] == &run)
        return fmt::format("{0}{1}{2}-{0}{1}{3}", piece.number, letters, side == 0 ? "a" : "b",
                           side == 0 ? "b" : "a");
    ++side;
  }
  return fmt::format("{}{}", piece.number, letters);
}

}  // namespace toile
