// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/conformal_map.h"

namespace toile::detail {

/// Turns over what lies the wrong side up: of each heap of such triangles the neighbourhood is
/// moved, as little as it takes, to where no triangle is turned over and all keep near their shape
/// and size. What is symmetric stays so to the last bit. Where a neighbourhood does not suffice a
/// larger one is taken; what then is left stays.
/// @see Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free Maps in 50 Lines of
///   Code", ACM TOG 40(4), 2021.
void untangle(const ConformalPatch& patch, std::vector<Eigen::Vector2d>& places);

}  // namespace toile::detail
