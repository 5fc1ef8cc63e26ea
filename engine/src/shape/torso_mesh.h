// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/mesh/mesh.h"

namespace toile {

/// A closed torso with stumps of neck, arms and legs, about 1 : 1 a woman of 1.68 m; feet would
/// stand on z = 0, the front is -y.
struct TorsoMesh {
  Mesh mesh;
  VertexData<VertexId> partner;       ///< across x = 0, exact
  std::vector<VertexId> frontColumn;  ///< on x = 0, from the top of the neck down to the crotch
  std::vector<VertexId> backColumn;   ///< the same behind
};
TorsoMesh makeTorsoMesh();

}  // namespace toile
