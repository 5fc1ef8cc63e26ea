// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/unfold/symmetrise.h"
#include "unfold/solution.h"

namespace toile::unfolding {

/// Least strain with exact lengths in a plane that covers nothing twice: from a convex start, with
/// boundary edges that push each other apart.
/// @param symmetry may be null.
/// @return NotConverged when no such plane was found; Cancelled.
/// @par Cost  a factorisation a step, a new order of elimination when other edges meet.
[[nodiscard]] Result<Solution> keepApart(const Problem& problem, const UnfoldOptions& options,
                                         const PieceSymmetry* symmetry, const Piece& piece,
                                         Progress* progress);

}  // namespace toile::unfolding
