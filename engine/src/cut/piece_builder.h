// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "toile/cut/cut.h"

namespace toile::cutting {

/// The surface is opened along this edge of the refined mesh; the model's border is open anyway.
[[nodiscard]] bool isOpened(const RefinedMesh& refined, EdgeId edge);

/// The parts into which the opened edges divide the refined mesh: faces of each, ascending, parts
/// by their smallest face and so by where they lie on the model.
[[nodiscard]] std::vector<std::vector<FaceId>> findRegions(const RefinedMesh& refined);

/// A piece with what ties it to the refined mesh.
struct PieceBuild {
  Piece piece;                      ///< without id, name and records
  std::vector<FaceId> refinedFace;  ///< by face of the piece; corner k is corner k
  /// Per wire and edge the halfedge of the refined mesh. Along boundary wires the one in the piece.
  std::vector<std::vector<HalfedgeId>> wireHalfedges;
};

/// Opens the region along its cuts and gives it its wires.
/// @param openedAt  opened and border edges at each vertex of the refined mesh.
Result<PieceBuild> buildPiece(const RefinedMesh& refined, std::span<const FaceId> region,
                              const VertexData<std::uint32_t>& openedAt,
                              std::span<const PlacedCurve> curves);

/// Adds the wires: boundary wires around the loops, then inner ones.
void addWires(PieceBuild& build, const RefinedMesh& refined,
              const VertexData<std::uint32_t>& openedAt, std::span<const PlacedCurve> curves);

/// Pairs the Seam and Dart wires of included pieces that are the two sides of one seam.
[[nodiscard]] std::vector<SeamMates> findMates(const RefinedMesh& refined,
                                               std::span<const PieceBuild> builds);

}  // namespace toile::cutting
