// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "finish/outline.h"

namespace toile {

/// A mitred corner reaches at most this many allowances out; beyond, it is cut off square to the
/// corner's bisector.
inline constexpr double kMitreLimit = 2.5;
/// The cut line may be this far off its allowance (away from corners) before a finding says so.
inline constexpr double kAllowanceToleranceMm = 0.1;

/// How the cut line turns where a run begins and the one before it ends.
struct Corner {
  CornerStyle style = CornerStyle::Mitre;
  /// Of a square or mirrored corner: its side is the run that begins here, not the one before it.
  bool byNext = false;
  /// By how much the parallel of the run before, and of the one that begins, may be prolonged.
  double reachBefore = std::numeric_limits<double>::infinity();
  double reachNext = std::numeric_limits<double>::infinity();
};

/// By how much the parallels of the runs that meet where run `index` begins are prolonged, by the
/// style alone; 0 at a concave or smooth point.
struct CornerReach {
  double before = 0, next = 0;
};
[[nodiscard]] CornerReach cornerReach(const SewOutline& sew, std::size_t index,
                                      const Corner& corner);

/// The outline moved outwards by the allowance of each run; equal to the sew lines where no run has
/// any. Holes that the allowance closes have no loop.
///
/// The union of the piece with a strip beside each edge, with the sectors of convex turns and with
/// the corners: loops of a naive parallel cannot arise. Folded darts are filled and get a cap.
/// @param corners per run of `sew`; empty = mitres
[[nodiscard]] std::vector<Outline> makeCutLines(const SewOutline& sew,
                                                const std::vector<Corner>& corners = {});

/// The darts of an outline that are folded, each as the runs of its two legs, and its tips.
struct FoldedDart {
  std::size_t firstRun = 0;  ///< of the first leg; its runs follow each other in the loop
  std::size_t runCount = 0;
  std::size_t loop = 0;
  bool isInner = false;           ///< both ends inside the piece: a loop of its own
  std::vector<std::size_t> tips;  ///< points of the loop
};
[[nodiscard]] std::vector<FoldedDart> foldedDarts(const SewOutline& sew);

/// Measures what makeCutLines() promises: the sew line lies inside, and away from corners and from
/// changes of width the lines are an allowance apart.
[[nodiscard]] std::vector<Finding> checkCutLines(const SewOutline& sew,
                                                 const std::vector<Outline>& cutLines,
                                                 const Piece& piece);

}  // namespace toile
