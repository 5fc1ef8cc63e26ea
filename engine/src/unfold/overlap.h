// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/unfold/unfold.h"
#include "unfold/problem.h"

namespace toile::unfolding {

/// The parts of the plane that are covered twice, by pairs of connected layers of faces; by falling
/// area. For pieces whose wires cross: others have none.
/// @par Cost  about linear in the faces plus the pairs that overlap.
[[nodiscard]] std::vector<Overlap> findOverlaps(const Piece& piece, const Problem& problem,
                                                const Plane& q);

}  // namespace toile::unfolding
