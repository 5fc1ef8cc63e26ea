// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/sheet_edits.h"

#include <algorithm>
#include <cmath>

#include "document/piece_edits.h"

namespace toile::studio {

std::optional<Document> withPieceOnSheet(const Document& document, const Pattern& pattern,
                                         std::size_t index, const Placement& wanted) {
  const PatternPiece& piece = pattern.pieces[index];
  // A piece without a record has no id that lasts.
  const auto recorded = withPieceRecord(document, pattern, piece.id, [](PieceRecord&) {});
  if (!recorded) return std::nullopt;
  const bool isNew = recordOf(*document.design, piece.id) == nullptr;
  Design design = *recorded->design;
  HandPlacement hand = placedByHand(pattern.layout, piece, index, wanted);
  if (isNew) hand.piece = design.pieces.back().id;
  const auto known = std::ranges::find(design.layout, hand.piece, &HandPlacement::piece);
  if (known == design.layout.end()) {
    design.layout.push_back(std::move(hand));
  } else {
    hand.unknown = std::move(known->unknown);
    *known = std::move(hand);
  }
  return Document{std::make_shared<const Design>(std::move(design)), document.model};
}

Document withoutHand(const Document& document, const std::string& piece) {
  Design design = *document.design;
  std::erase_if(design.layout, [&](const HandPlacement& hand) { return hand.piece == piece; });
  return {std::make_shared<const Design>(std::move(design)), document.model};
}

std::optional<Document> withGrainTurned(const Document& document, const Pattern& pattern,
                                        const std::string& piece, Angle by) {
  return withPieceRecord(document, pattern, piece, [&](PieceRecord& record) {
    if (!record.grain) record.grain.emplace();
    const double turn = record.grain->turn.degrees() + by.degrees();
    record.grain->turn = Angle::degrees(std::remainder(turn, 360.0));
  });
}

}  // namespace toile::studio
