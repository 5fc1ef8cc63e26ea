// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/unfold/symmetrise.h"
#include "unfold/block_matrix.h"
#include "unfold/problem.h"

namespace toile::unfolding {

[[nodiscard]] MirrorTies tiesOf(const PieceSymmetry& symmetry, std::size_t vertexCount);

/// A placement without folds whose paired vertices are mirror images in x = 0, to the last bit.
/// @return NotConverged when none was found.
[[nodiscard]] Result<Plane> symmetricStart(const Problem& problem,
                                           const std::vector<Eigen::Vector3d>& positions,
                                           std::pair<std::uint32_t, std::uint32_t> hold,
                                           const PieceSymmetry& symmetry);

}  // namespace toile::unfolding
