// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toile/unfold/unfold.h"

namespace toile {

/// Which vertices of a piece's outline are mirror images of each other.
struct PieceSymmetry {
  std::vector<std::pair<VertexId, VertexId>> pairs;
  std::vector<VertexId> axis;  ///< the two where the outline meets its axis
};

/// A piece whose outline has the same points and lengths on both sides.
struct SymmetricPiece {
  Piece piece;
  PieceSymmetry symmetry;
  std::size_t addedVertices = 0;  ///< they come last; without any the mesh is the old one
  double asymmetry = 0;           ///< mm: greatest distance of the outline from its mirror image
  double maxLengthChange = 0;     ///< relative: of a target by taking the mean of both sides
};

/// Makes the data of a nearly symmetric piece symmetric, so that its unfolding can be so exactly.
///
/// Finds the plane in which the outer outline is nearest to its own mirror image, splits outline
/// edges where the other side has a point (faces are parted in a fan), and gives the edges of a
/// pair the mean of their targets. Inner wires and holes stay as they are. When vertices were added
/// `onModel` is empty.
///
/// Targets change, thus a seam's other side must be told: made for single pieces.
/// @param tolerance greatest distance of the outline from its mirror image, as a share of the
/// square
///   root of the area.
/// @return nothing for a piece that is not symmetric, cannot lie flat, or would need points on the
///   side of a dart.
[[nodiscard]] std::optional<SymmetricPiece> symmetrise(const Piece& piece, double tolerance = 0.02);

/// unfold() with an outline that is its own mirror image, to the last bit: the axis is upright or
/// level, whichever is nearer to the model's, and runs through 0. With
/// WireWarping the symmetry of the data alone makes the outline nearly so.
Result<FlatPiece> unfold(const SymmetricPiece& piece, const UnfoldOptions& options = {},
                         Progress* progress = nullptr);

/// As the other writePatchObj(), of the piece with its added points: vertices and faces of the old
/// mesh keep their numbers, parted faces say where they come from (`# source-face <face> <old
/// face>`, counted from 0), and all wires stand as chains with the targets that differ from the
/// surface.
std::string writePatchObj(const SymmetricPiece& piece, const FlatPiece& flat);

}  // namespace toile
