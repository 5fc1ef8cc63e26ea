// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/layout/pattern.h"

#include "toile/core/parallel.h"

namespace toile {

bool Pattern::isComplete() const {
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    if (!cut.pieces[i].include) continue;
    if (i >= flats.size() || !flats[i] || !flats[i]->check.passes()) return false;
    if (i < failures.size() && failures[i]) return false;
  }
  return true;
}

const Piece& Pattern::shapedPiece(std::size_t index) const {
  const bool isProcessed = index < developed.size() && developed[index];
  return isProcessed ? developed[index]->piece : cut.pieces[index];
}

std::vector<std::optional<PieceStrain>> measureStrains(const Pattern& pattern) {
  std::vector<std::optional<PieceStrain>> strains(pattern.cut.pieces.size());
  parallelFor(pattern.pieces.size(), [&](std::size_t k) {
    const std::size_t i = pattern.pieceIndex[k];
    if (!pattern.flats[i]) return;
    strains[i] = measureStrain(pattern.document, pattern.shapedPiece(i), *pattern.flats[i],
                               pattern.pieces[k]);
  });
  return strains;
}

}  // namespace toile
