// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toile/develop/darts.h"
#include "toile/edit/edited.h"
#include "toile/pipeline.h"

namespace toile {

// What helps a piece of a pattern that lies flat badly, and the document with it done. All take a
// full pattern (makePattern()) and the index of a piece in its cut.

/// Darts and cuts for one piece of a pattern, the best first, with the cloth and the limit of its
/// fabric; also for a piece that was refused because it lies on itself.
/// @return none if no line helps; the errors of adviseDarts() and unfold(), Cancelled
/// @par Cost  DartOptions::maxProposals times unfold()
Result<std::vector<DartProposal>> adviseDarts(const Pattern& pattern, std::size_t piece,
                                              Progress* progress = nullptr);

/// A proposed line where people see it.
struct ProposedLine {
  std::vector<Eigen::Vector3d> onBody, normals;
  std::vector<Eigen::Vector2d> inPlane;  ///< of the flat piece; empty where it has none
};
/// The line of the proposal and its companions.
[[nodiscard]] std::vector<ProposedLine> proposedLines(const Pattern& pattern, std::size_t piece,
                                                      const DartProposal& proposal);

/// The document with the lines of a proposal, as `--auto-dart` puts them: on a model with symmetry
/// their mirror images too, where the piece on the other side is its mirror image.
Result<Edited> withProposal(const Pattern& pattern, std::size_t piece,
                            const DartProposal& proposal);

/// The document with a piece that cannot lie flat cut open the shortest way, as `--auto-cut` does.
/// @return InvalidArgument for a piece that can lie flat, or that no cut would open
Result<Edited> withShortestCuts(const Pattern& pattern, std::size_t piece);

/// What developable processing by `amount` would do to a piece.
/// @param amount t, 0..1
/// @return the errors of develop()
Result<DevelopedPiece> tryDeveloping(const Pattern& pattern, std::size_t piece, double amount,
                                     Progress* progress = nullptr);

}  // namespace toile
