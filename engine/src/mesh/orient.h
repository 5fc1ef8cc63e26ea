// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/edge_sides.h"

namespace toile::detail {

struct Orientation {
  std::vector<std::uint32_t> turned;     ///< faces turned one by one, ascending
  std::vector<std::uint32_t> turnedOut;  ///< first faces of closed components turned as a whole
  std::vector<std::uint32_t> cavities;   ///< first faces of closed components left facing inward
  /// Edges where no turning helps, as vertex pairs: the surface is not orientable.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> contradictions;
  std::vector<std::uint32_t> firstFaceOfComponent;
};

/// Turns faces (b and c exchanged) so that neighbours agree, by majority in each component; closed
/// components then face outward, unless they lie within the box of another closed component and
/// face inward: that is a hollow. Precondition: no edge has more than two faces.
Orientation orientConsistently(const std::vector<Eigen::Vector3d>& positions,
                               std::vector<Triangle>& triangles,
                               const std::vector<EdgeSide>& sides);

}  // namespace toile::detail
