// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "unfold/solution.h"

namespace toile::unfolding {

/// The wires alone bent the least: minimises J = sum w (theta - alpha)^2 over the wire corners with
/// exact lengths, then fills in the cloth between them with the least strain.
///
/// Positions are the unknowns, not angles: the same minimum, and no network of wires needs a case
/// of its own (holes, lines that float or end in the cloth, junctions). Several starts; of those
/// whose wires do not cross the lowest J counts. Parts of the wires that nothing joins lie where
/// the cloth strains the least.
/// @see Wang, "WireWarping: A Fast Surface Flattening Approach with Length-preserved Feature
///   Curves", Computer-Aided Design 40(3), 2008.
[[nodiscard]] Result<Solution> warpWires(const Piece& piece, const Problem& problem,
                                         const UnfoldOptions& options, Progress* progress);

}  // namespace toile::unfolding
