// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/develop/darts.h"

namespace toile::developing {

/// A way that a dart or cut could take, and how much of the curvature's area error it would leave.
struct Candidate {
  SurfacePath path;  ///< from its mouth; a dart's ends before the apex
  VertexId apex;
  double bulge = 0;
  double length = 0;
  double errorLeft = 0;  ///< estimated mean area error with the path as a wire
};

/// Ways from the boundary to where the curvature weighs most, those that leave least first. Bulges
/// give darts, saddles the two halves of a cut as one path.
[[nodiscard]] std::vector<Candidate> findCandidates(const Piece& piece, const DartOptions& options);

}  // namespace toile::developing
