// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/pipeline.h"

namespace toile {

/// Makes pieces the mirror images of those that their records name as twins: their mesh, and the
/// targets along all their wires, which their neighbours take over.
///
/// The two must be mirror images of each other by the model's pairing of vertices, as the lines of
/// one side that are `mirrorOf` those of the other make them; the model itself may be crooked.
/// Pieces that are not stay true to their own sides, with a finding.
void makeTwins(Pattern& pattern);

/// The plane of a piece's mirror image.
[[nodiscard]] FlatPiece mirrorImage(const FlatPiece& flat);

}  // namespace toile
