// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/pipeline.h"

namespace toile {

/// Finds for each elastic line of the design, together with its mirror images, one ratio that
/// serves all pieces it runs through or bounds, and gives the edges of the cut the targets that it
/// means; then nothing is elastic any more.
///
/// Each piece is unfolded with ratios of its own, and tells what others would cost it to second
/// order; the sum of these costs is made least within the ranges. Pieces that cannot be unfolded
/// have no say.
void settleElastics(Pattern& pattern, const MakeOptions& options, Progress* progress);

}  // namespace toile
