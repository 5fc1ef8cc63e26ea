// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "toile/layout/pattern.h"

namespace toile::studio {

/// Puts a piece where a hand has moved it on the sheet.
/// @param pattern the last full one of this document
/// @param index of the pattern piece
std::optional<Document> withPieceOnSheet(const Document& document, const Pattern& pattern,
                                         std::size_t index, const Placement& wanted);
/// Gives a piece back to the layout.
Document withoutHand(const Document& document, const std::string& piece);

/// Turns the grain of a piece, counter-clockwise on the piece.
std::optional<Document> withGrainTurned(const Document& document, const Pattern& pattern,
                                        const std::string& piece, Angle by);

}  // namespace toile::studio
