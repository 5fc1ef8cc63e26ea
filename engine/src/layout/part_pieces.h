// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "layout/placed_piece.h"

namespace toile {

/// Moves the pieces of one side of the map apart by the article's rule (toile/layout/layout.h).
/// @param pieces indices of that side's pieces in `placed`
/// @param mirror per piece of `placed` the one that mirrors it
void partPieces(std::vector<PlacedPiece>& placed, const std::vector<std::size_t>& pieces,
                const std::vector<std::optional<std::size_t>>& mirror);

}  // namespace toile
