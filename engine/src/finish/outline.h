// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/finish/pattern_piece.h"

namespace toile {

/// A point where the line turns by more than this is a corner ...
inline constexpr double kCornerDegrees = 20;
/// ... and by more than this where two wires meet, since there the seams end.
inline constexpr double kJunctionCornerDegrees = 7;

/// The sew lines of a piece and what each stretch of them is.
struct SewOutline {
  std::vector<Outline> loops;    ///< 0 is the outer one; a loop begins where a run begins
  std::vector<OutlineRun> runs;  ///< by loop, in order along it; allowance 0
};

/// Joins the boundary wires to loops at the exact flat positions.
/// @return InvalidArgument where wires do not close or the flat piece does not fit the piece
Result<SewOutline> makeSewOutline(const Piece& piece, const FlatPiece& flat);

}  // namespace toile
