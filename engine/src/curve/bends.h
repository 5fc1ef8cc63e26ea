// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::detail {

/// Changes of side in a row of turns (radians): bends are runs of one sign; those that turn by less
/// than `least` are joined to what is around them, the smallest first.
[[nodiscard]] int countInflections(const std::vector<double>& turns, bool closed, double least);

/// Even samples at which a line of a length (mm) is judged and faired: fine enough for its bends,
/// coarser than the noise of the mesh.
[[nodiscard]] std::size_t evenSampleCount(const Mesh& mesh, double length);

}  // namespace toile::detail
