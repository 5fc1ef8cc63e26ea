// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/piece_colours.h"

#include "app/palette.h"

namespace toile::studio {

QColor pieceTint(const Pattern& pattern, std::size_t index, PieceColours colours) {
  const Piece& piece = pattern.cut.pieces[index];
  if (!piece.include || !pattern.flats[index]) return palette().clay;
  if (colours == PieceColours::Piece) return fabricTint(index);
  const Design& design = *pattern.document.design;
  const Fabric* fabric = fabricOf(design, recordOf(design, piece.id));
  const auto number = fabric == nullptr ? 0 : fabric - design.fabrics.data();
  return fabricTint(static_cast<std::size_t>(number));
}

}  // namespace toile::studio
