// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "toile/develop/develop.h"
#include "toile/finish/strain.h"
#include "toile/layout/layout.h"

namespace toile {

/// Everything that was made from a document. `flats`, `failures`, `developed` run parallel to
/// `cut.pieces`.
struct Pattern {
  Document document;
  std::vector<PlacedCurve> curves;
  CutResult cut;
  std::vector<std::shared_ptr<const FlatPiece>> flats;  ///< null: left out, or failed
  /// What developable processing did; null where there was none. `flats` is of the processed shape,
  /// `cut` holds the piece on the body with the target lengths of that shape.
  std::vector<std::shared_ptr<const DevelopedPiece>> developed;
  std::vector<std::optional<Error>> failures;  ///< why a piece could not be unfolded
  std::vector<PatternPiece> pieces;            ///< of the flats that passed every check
  std::vector<std::uint32_t> pieceIndex;       ///< per pattern piece: index in cut.pieces
  Layout layout;
  /// Per piece: the one whose mirror image it is made to be, with its mesh and numbering, corners 1
  /// and 2 of each face exchanged. Empty = none.
  std::vector<std::optional<std::uint32_t>> twinOf;
  /// The elastic lines in the design's order; `cut` holds the targets that their ratios gave.
  std::vector<ElasticLine> elastics;
  std::vector<Finding> findings;  ///< of all steps, in their order

  /// Every included piece was unfolded and passed its checks.
  [[nodiscard]] bool isComplete() const;
  /// The piece in the shape that its plane is of: the processed one where there was processing.
  [[nodiscard]] const Piece& shapedPiece(std::size_t index) const;
};

/// The strain of every pattern piece, parallel to `cut.pieces`; nothing for the others.
[[nodiscard]] std::vector<std::optional<PieceStrain>> measureStrains(const Pattern& pattern);

}  // namespace toile
