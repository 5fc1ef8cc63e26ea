// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/unfold_options.h"

namespace toile {

UnfoldOptions unfoldOptionsOf(const Design& design, const Piece& piece,
                              const UnfoldOptions& options) {
  const PieceRecord* record = recordOf(design, piece.id);
  const Fabric* fabric = fabricOf(design, record);
  const bool isWoven = fabric != nullptr && fabric->weights;
  const bool isTurned = record != nullptr && record->grain;
  if (options.cloth || (!isWoven && !isTurned)) return options;
  UnfoldOptions own = options;
  Cloth& cloth = own.cloth.emplace();
  if (isWoven) cloth.weights = *fabric->weights;
  if (fabric != nullptr) {
    cloth.stretchAlong = fabric->stretchAlong;
    cloth.stretchAcross = fabric->stretchAcross;
    cloth.shear = fabric->shear;
  }
  if (isTurned) cloth.grain = *record->grain;
  return own;
}

}  // namespace toile
