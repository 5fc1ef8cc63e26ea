// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "toile/cut/cut.h"

namespace toile::cutting {

/// The paths of the curves that are cut along, where each end that lies on another path is a point
/// of that path too. Such an end may become a node up to the merge distance away; as a point of
/// both they move together, and a seam that was drawn up to another one stays joined to it.
std::vector<SurfacePath> withJoinedEnds(const Mesh& mesh, std::span<const PlacedCurve> curves);

}  // namespace toile::cutting
