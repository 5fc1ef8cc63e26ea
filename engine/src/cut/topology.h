// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/cut/cut.h"

namespace toile::cutting {

struct LoopTurning {
  std::vector<HalfedgeId> halfedges;  ///< with the surface on the left
  /// Sum of pi minus the surface angle over its vertices: 2 pi around a flat disk, -2 pi around a
  /// hole in it, 0 around a cylinder.
  double turning = 0;
  /// A flat piece can keep it closed: some other loop turns like an outline, this one like a hole.
  /// The line is drawn half-way between a flat ring and a tube.
  bool isHole = false;
};

/// The boundary loops of a mesh in its own order.
[[nodiscard]] std::vector<LoopTurning> measureLoops(const Mesh& mesh);

}  // namespace toile::cutting
