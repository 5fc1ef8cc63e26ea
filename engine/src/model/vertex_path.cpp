// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/vertex_path.h"

#include "toile/core/assert.h"

namespace toile {

SurfacePath vertexPath(const Mesh& mesh, const std::vector<VertexId>& vertices, bool closed) {
  SurfacePath path;
  path.closed = closed;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    path.points.push_back({vertices[i]});
    if (i + 1 == vertices.size() && !closed) break;
    const EdgeId edge = mesh.findEdge(vertices[i], vertices[(i + 1) % vertices.size()]);
    TOILE_ASSERT(edge.isValid());
    path.faceOfSegment.push_back(mesh.face(mesh.halfedge(edge)));
  }
  return path;
}

}  // namespace toile
