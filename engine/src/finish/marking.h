// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "finish/polygon.h"
#include "toile/finish/pattern_piece.h"

namespace toile {

/// Features and elastic lines of the piece, in the order of its wires, and the marks that cross it.
[[nodiscard]] std::vector<InternalLine> internalLines(const Document& document,
                                                      const std::vector<PlacedCurve>& curves,
                                                      const Piece& piece, const FlatPiece& flat);

/// A line along the piece's up, at least 60 % of the piece's height where that fits inside, beside
/// the label rather than through it.
[[nodiscard]] std::array<Eigen::Vector2d, 2> grainLine(const std::vector<Points2>& loops,
                                                       const Eigen::Vector2d& labelPosition);

/// Name, number and count, fabric, order, seam allowance; lines that would say nothing are left
/// out.
[[nodiscard]] std::vector<std::string> labelLines(const Design& design, const PatternPiece& piece);

}  // namespace toile
