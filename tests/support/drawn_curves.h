// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include "toile/design/design.h"

namespace toile::test {

/// A path through points of which each two neighbours share a face.
SurfacePath pathThrough(const Mesh& mesh, std::vector<SurfacePoint> points, bool closed = false);
/// Along the mesh edges between these vertices, each joined to the next by an edge.
SurfacePath edgePath(const Mesh& mesh, const std::vector<VertexId>& vertices, bool closed = false);
/// The loops and lines where the plane normal . x = offset cuts the mesh. Precondition: no vertex
/// lies on the plane.
std::vector<SurfacePath> planeSections(const Mesh& mesh, const Eigen::Vector3d& normal,
                                       double offset);
PlacedCurve drawn(std::string id, CurveKind kind, SurfacePath path);

/// A design that is hard to cut: lines that cross, share parts, run through vertices and along
/// edges, end on others, and run beside earlier ones at 1e-3 .. 1e-9 mm or the distance that
/// merges.
std::vector<PlacedCurve> randomCurves(const Mesh& mesh, int count, std::mt19937_64& random);

}  // namespace toile::test
