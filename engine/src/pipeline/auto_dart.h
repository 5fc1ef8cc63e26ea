// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/symmetric_pieces.h"

namespace toile {

/// Adds the best dart (across a saddle: a cut) of every piece over the limit or upon itself to the
/// pattern's design; on a model with symmetry its mirror image too, where the piece, or the piece
/// on the other side, is symmetric.
/// @param cache holds what the pieces were unfolded to
/// @param findings gets one per line added, and why a piece stays over the limit
/// @return whether there were any
Result<bool> addProposedDarts(Pattern& pattern, const Symmetries& symmetries,
                              const MakeOptions& options, const PatternCache& cache,
                              std::vector<Finding>& findings, Progress* progress);

}  // namespace toile
