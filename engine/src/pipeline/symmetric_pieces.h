// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/pipeline.h"
#include "toile/unfold/symmetrise.h"

namespace toile {

/// Per piece: the vertices of its outline that are made mirror images of each other; the targets of
/// their edges are equal. Empty = none.
using Symmetries = std::vector<std::optional<PieceSymmetry>>;

/// Makes the outlines of pieces that are symmetric up to a share of their size exactly so: each
/// side gets the points that the other has, as nodes of the cut, and the edges of a pair the mean
/// of their targets. The cut's edges own these, so that the other side of
/// a seam follows; edges that several symmetric pieces pair take the mean of all of them.
///
/// Pairs are those of the model's vertices where its pairing maps the outline onto itself, however
/// crooked the model is; else those at equal shares of the way from line end to line end. Twins
/// take their original's outline and are left alone.
/// @return errors of cut()
Result<Symmetries> makePiecesSymmetric(Pattern& pattern, Ratio tolerance, Progress* progress);

/// The symmetry that the targets of a piece still have: elastic lines and twins come later. Null
/// without.
[[nodiscard]] const PieceSymmetry* symmetryOf(const Pattern& pattern, const Symmetries& symmetries,
                                              std::size_t piece);

}  // namespace toile
