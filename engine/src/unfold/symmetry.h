// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "toile/unfold/symmetrise.h"
#include "unfold/block_matrix.h"
#include "unfold/problem.h"
#include "unfold/sparse_factor.h"

namespace toile::unfolding {

struct MirrorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;
};

/// The plane in which a piece is nearly its own mirror image.
/// @param tolerance greatest distance of outline, inner wires and surface from their image, as a
///   share of the root of the area.
/// @return nothing for a piece that is not symmetric or cannot lie flat.
[[nodiscard]] std::optional<MirrorPlane> findMirrorPlane(const Piece& piece, double tolerance);

[[nodiscard]] MirrorTies tiesOf(const PieceSymmetry& symmetry, std::size_t vertexCount);

/// The symmetry of a piece that is its own mirror image to rounding: outline with its points and
/// targets, inner wires; its surface may be meshed in another way.
[[nodiscard]] std::optional<PieceSymmetry> findExactSymmetry(const Piece& piece,
                                                             const Problem& problem);

/// A placement without folds whose paired vertices are mirror images in x = 0, to the last bit.
/// @param pattern with the ties of the symmetry.
/// @return NotConverged when none was found.
[[nodiscard]] Result<Plane> symmetricStart(const Problem& problem,
                                           const std::vector<Eigen::Vector3d>& positions,
                                           const PieceSymmetry& symmetry,
                                           const BlockPattern& pattern, SparseFactor& factor);

}  // namespace toile::unfolding
