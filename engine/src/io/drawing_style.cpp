// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/drawing_style.h"

namespace toile {

std::vector<Colour> pieceColours(const CutResult& cut) {
  const std::size_t count = cut.pieces.size();
  std::vector<std::vector<std::uint32_t>> neighbours(count);
  for (const SeamMates& mates : cut.mates) {
    neighbours[mates.pieceA].push_back(mates.pieceB);
    neighbours[mates.pieceB].push_back(mates.pieceA);
  }
  std::vector<std::size_t> tint(count, kFabricTints.size());
  std::vector<Colour> colours(count, kClay);
  std::array<std::size_t, kFabricTints.size()> uses{};
  for (std::size_t piece = 0; piece < count; ++piece) {
    if (!cut.pieces[piece].include) continue;
    std::array<std::size_t, kFabricTints.size()> clashes{};
    for (const std::uint32_t other : neighbours[piece]) {
      if (tint[other] < clashes.size()) ++clashes[tint[other]];
    }
    std::size_t best = 0;
    for (std::size_t each = 1; each < kFabricTints.size(); ++each) {
      const bool fewerClashes = (clashes[each] > 0) < (clashes[best] > 0);
      const bool asFew = (clashes[each] > 0) == (clashes[best] > 0);
      if (fewerClashes || (asFew && uses[each] < uses[best])) best = each;
    }
    tint[piece] = best;
    ++uses[best];
    colours[piece] = kFabricTints[best];
  }
  return colours;
}

}  // namespace toile
