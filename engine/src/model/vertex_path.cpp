// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/vertex_path.h"

#include <algorithm>

#include "toile/core/assert.h"

namespace toile {
namespace {

FaceId mirroredFace(const Mesh& mesh, const VertexData<VertexId>& partner, FaceId face) {
  const Triangle& corners = mesh.vertices(face);
  const VertexId a = partner[corners[0]];
  const VertexId b = partner[corners[1]];
  const VertexId c = partner[corners[2]];
  for (const FaceId candidate : mesh.facesAround(a)) {
    const Triangle& others = mesh.vertices(candidate);
    const auto has = [&](VertexId v) {
      return std::find(others.begin(), others.end(), v) != others.end();
    };
    if (has(b) && has(c)) return candidate;
  }
  TOILE_ASSERT(false && "the pairing is an automorphism of the mesh");
  return face;
}

}  // namespace

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

SurfacePoint mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                      const SurfacePoint& point) {
  if (const auto* vertex = std::get_if<VertexId>(&point.at)) return {partner[*vertex]};
  if (const auto* onEdge = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    const VertexId tail = partner[mesh.tail(onEdge->edge)];
    const VertexId head = partner[mesh.head(onEdge->edge)];
    const EdgeId edge = mesh.findEdge(tail, head);
    TOILE_ASSERT(edge.isValid());
    return {SurfacePoint::OnEdge{edge, tail < head ? onEdge->t : 1 - onEdge->t}};
  }
  const auto& inFace = std::get<SurfacePoint::InFace>(point.at);
  const FaceId face = mirroredFace(mesh, partner, inFace.face);
  const Triangle& corners = mesh.vertices(inFace.face);
  const Triangle& others = mesh.vertices(face);
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = std::find(others.begin(), others.end(), partner[corners[k]]) - others.begin();
    weights[at] = inFace.barycentric[static_cast<Eigen::Index>(k)];
  }
  return {SurfacePoint::InFace{face, weights}};
}

SurfacePath mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                     const SurfacePath& path) {
  SurfacePath out;
  out.closed = path.closed;
  for (const SurfacePoint& point : path.points) {
    out.points.push_back(mirrored(mesh, partner, point));
  }
  for (const FaceId face : path.faceOfSegment) {
    out.faceOfSegment.push_back(mirroredFace(mesh, partner, face));
  }
  return out;
}

}  // namespace toile
