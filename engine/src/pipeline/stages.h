// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/symmetric_pieces.h"
#include "toile/pipeline.h"

// The steps of makePattern(), each on a pattern that the steps before have filled.
namespace toile::stages {

[[nodiscard]] Error cancelled();
/// What people call a piece in messages.
[[nodiscard]] std::string quoted(const Piece& piece);

/// Puts the curves on the model, cuts it, makes symmetric pieces and twins so.
Result<Symmetries> placeAndCut(Pattern& pattern, const MakeOptions& options, Progress* progress);
/// The same, and opens what cannot lie flat.
Result<Symmetries> placeAndCutOpen(Pattern& pattern, const MakeOptions& options,
                                   Progress* progress);

/// Included pieces with the most faces first, so that the last one to end is a small one.
[[nodiscard]] std::vector<std::size_t> workOrder(const CutResult& cut);
/// How a piece is to be processed; nothing where it stays as it was cut.
[[nodiscard]] std::optional<DevelopOptions> developOptions(const Pattern& pattern,
                                                           const Piece& piece,
                                                           const MakeOptions& options);
/// What the plane of a piece is a function of.
/// @param symmetry may be null
[[nodiscard]] ContentHash cacheKey(const Pattern& pattern, std::size_t piece,
                                   const PieceSymmetry* symmetry, const MakeOptions& options);

/// Fills `flats`, `developed` and `failures` from entries, one per piece of the cut (null where
/// there is none), with what they have to tell.
void takeEntries(Pattern& pattern, const std::vector<const PatternCache::Entry*>& entries);

/// Unfolds all included pieces.
void unfoldPieces(Pattern& pattern, const Symmetries& symmetries, const MakeOptions& options,
                  PatternCache& cache, Progress* progress);

/// Makes pattern pieces of the pieces that have a plane.
/// @param known  as for finish()
Result<void> finishPieces(Pattern& pattern, Progress* progress,
                          const std::vector<const PatternPiece*>& known = {});
Result<void> arrangePieces(Pattern& pattern, Progress* progress);

}  // namespace toile::stages
