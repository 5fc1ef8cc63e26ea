// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "finish/outline.h"

namespace toile {

/// A mitred corner reaches at most this many allowances out; beyond, it is cut off square to the
/// corner's bisector.
inline constexpr double kMitreLimit = 2.5;
/// The cut line may be this far off its allowance (away from corners) before a finding says so.
inline constexpr double kAllowanceToleranceMm = 0.1;

/// The outline moved outwards by the allowance of each run; equal to the sew lines where no run has
/// any. Holes that the allowance closes have no loop.
///
/// The union of the piece with a strip beside each edge, with the sectors of convex turns and with
/// the mitres of corners: loops of a naive parallel cannot arise.
[[nodiscard]] std::vector<Outline> makeCutLines(const SewOutline& sew);

/// Measures what makeCutLines() promises: the sew line lies inside, and away from corners and from
/// changes of width the lines are an allowance apart.
[[nodiscard]] std::vector<Finding> checkCutLines(const SewOutline& sew,
                                                 const std::vector<Outline>& cutLines,
                                                 const Piece& piece);

}  // namespace toile
