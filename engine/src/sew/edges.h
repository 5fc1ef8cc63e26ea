// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/finish/pattern_piece.h"

namespace toile {

/// Runs of a piece that are one edge to people: same curve and seam, following each other without
/// a corner between. Indices into its `runs`, each group in order along the outline.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> edgeGroups(const PatternPiece& piece);

/// Along the sew line of the pattern, mm.
[[nodiscard]] double drawnLength(const PatternPiece& piece, const OutlineRun& run);

[[nodiscard]] double total(const std::vector<double>& lengths);

/// The part of its wire that a run is: less than 1 where the piece is a half on a fold.
[[nodiscard]] double shareOf(const OutlineRun& run, const Wire& wire);

}  // namespace toile
