// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/mesh/surface_point.h"

namespace toile {

/// A path along mesh edges. Precondition: each vertex is joined to the next by an edge.
SurfacePath vertexPath(const Mesh& mesh, const std::vector<VertexId>& vertices, bool closed);

}  // namespace toile
