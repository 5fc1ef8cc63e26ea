// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/sheet_edits.h"

#include <cmath>

#include "document/piece_edits.h"

namespace toile::studio {

std::optional<Document> withGrainTurned(const Document& document, const Pattern& pattern,
                                        const std::string& piece, Angle by) {
  return withPieceRecord(document, pattern, piece, [&](PieceRecord& record) {
    if (!record.grain) record.grain.emplace();
    const double turn = record.grain->turn.degrees() + by.degrees();
    record.grain->turn = Angle::degrees(std::remainder(turn, 360.0));
  });
}

}  // namespace toile::studio
