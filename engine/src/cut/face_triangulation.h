// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "cut/node.h"
#include "toile/core/result.h"

namespace toile::cutting {

using LocalTriangle = std::array<std::uint32_t, 3>;
using LocalEdge = std::pair<std::uint32_t, std::uint32_t>;

/// Some triangulation of a face that has the given edges: every triangle counter-clockwise with
/// positive area in whole numbers, their areas adding up to the face exactly.
/// @param points  different; the three corners are among them, edges meet at points only.
/// @return an Error only where that promise is broken.
Result<std::vector<LocalTriangle>> triangulate(std::span<const LatticePoint> points,
                                               std::span<const LocalEdge> edges);

/// Flips edges until the triangulation is constrained Delaunay in the isometric plane of the face.
/// Whether a flip is allowed is decided exactly, whether it helps in double: quality alone.
/// @see Lawson, "Software for C1 surface interpolation", 1977.
void makeDelaunay(const FaceFrame& frame, std::span<const LatticePoint> points,
                  std::span<const LocalEdge> edges, std::vector<LocalTriangle>& triangles);

}  // namespace toile::cutting
