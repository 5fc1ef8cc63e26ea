// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/develop/darts.h"

namespace toile::developing {

/// Ways that darts or a cut could take, and how much of the curvature's area error they would
/// leave.
struct Candidate {
  std::vector<SurfacePath> paths;  ///< from their mouths; darts end before the apex
  VertexId apex;
  double bulge = 0;
  double length = 0;     ///< of all
  double errorLeft = 0;  ///< estimated mean area error with the paths as wires
  bool isSymmetric = false;
  bool isStar = false;  ///< darts spread evenly round a dome
};

/// Ways from the boundary to where the curvature weighs most, those whose darts gain most first;
/// stars come last, those with few darts first, and only with a limit in the options. Bulges give
/// darts, saddles the two halves of a cut as one path. A piece that is its own mirror image gets no
/// darts that are not, if there are others.
[[nodiscard]] std::vector<Candidate> findCandidates(const Piece& piece, const DartOptions& options);

}  // namespace toile::developing
