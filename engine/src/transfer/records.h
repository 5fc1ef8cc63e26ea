// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "toile/cut/cut.h"

namespace toile::detail {

/// The curves around a piece: for each of its boundary loops the ids in their cyclic order, runs of
/// one curve counted once, begun so that equal cycles are equal; loops sorted.
[[nodiscard]] std::vector<std::vector<std::string>> boundingCycles(const Piece& piece);

/// Compares the regions of the records with those of the design on its own model, in which it was
/// bounded by the same curves. An anchor that came to lie in another region goes to the inmost
/// point of the one region that is bounded as it was; what cannot be mended is reported.
/// @param cutAfter of `design` on the target
/// @return ids of curves that bound such a piece now and did not before; empty when all is well
std::set<std::string> checkRecords(Design& design, const Design& before, const CutResult& cutBefore,
                                   const CutResult& cutAfter, const Mesh& target,
                                   std::vector<Finding>& findings);

}  // namespace toile::detail
