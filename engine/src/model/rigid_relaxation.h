// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "model/conformal_map.h"

namespace toile::detail {

/// Brings a map that is right in its turns, such as a conformal one, near an isometry: every
/// triangle as rigid as possible, by a few steps between the triangles' best rotations and the
/// places that fit them best. Conformal maps draw limbs that hang on a trunk several times too
/// small or too large; this gives them back their size. With partners mirrored at x = 0 bit for
/// bit. Leaves the places as they are where the numbers give out.
/// @see Liu, Zhang, Xu, Gotsman, Gortler, "A Local/Global Approach to Mesh Parameterization", SGP
///   2008.
void relaxRigid(const ConformalPatch& patch, std::vector<Eigen::Vector2d>& places);

}  // namespace toile::detail
