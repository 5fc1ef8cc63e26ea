// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/level_path.h"

#include <algorithm>

#include "toile/core/assert.h"

namespace toile {
namespace {

SurfacePoint zeroOn(const Mesh& mesh, const VertexField& field, EdgeId edge) {
  const double tail = field[mesh.tail(edge)];
  const double head = field[mesh.head(edge)];
  return {SurfacePoint::OnEdge{edge, tail / (tail - head)}};
}

double valueAt(const Mesh& mesh, const VertexField& field, const SurfacePoint& point, FaceId face) {
  const Eigen::Vector3d weights = barycentricIn(mesh, point, face);
  const Triangle& corners = mesh.vertices(face);
  return weights[0] * field[corners[0]] + weights[1] * field[corners[1]] +
         weights[2] * field[corners[2]];
}

}  // namespace

VertexField planeField(const Mesh& mesh, const Eigen::Vector3d& normal,
                       const Eigen::Vector3d& through) {
  constexpr double kNudgeMm = 1e-7;
  VertexField field(mesh.vertexCount());
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const double value = normal.dot(mesh.position(VertexId(v)) - through);
    field[VertexId(v)] = value >= 0 ? std::max(value, kNudgeMm) : std::min(value, -kNudgeMm);
  }
  return field;
}

bool crosses(const Mesh& mesh, const VertexField& field, EdgeId edge) {
  return (field[mesh.tail(edge)] > 0) != (field[mesh.head(edge)] > 0);
}

SurfacePath levelPath(const Mesh& mesh, const VertexField& field, HalfedgeId into,
                      const std::function<bool(EdgeId)>& isLast) {
  SurfacePath path;
  const EdgeId start = mesh.edge(into);
  path.points.push_back(zeroOn(mesh, field, start));
  while (true) {
    TOILE_ASSERT(path.points.size() <= mesh.edgeCount());
    // The line leaves a triangle over the other side on which the sign changes.
    HalfedgeId out = mesh.next(into);
    if (!crosses(mesh, field, mesh.edge(out))) out = mesh.next(out);
    path.faceOfSegment.push_back(mesh.face(into));
    const EdgeId edge = mesh.edge(out);
    if (edge == start) {
      path.closed = true;
      return path;
    }
    path.points.push_back(zeroOn(mesh, field, edge));
    if (isLast(edge)) return path;
    into = mesh.opposite(out);
    TOILE_ASSERT(into.isValid());
  }
}

std::vector<SurfacePath> splitBySign(const Mesh& mesh, const SurfacePath& path,
                                     const VertexField& field) {
  std::vector<SurfacePath> parts(1);
  parts.back().points.push_back(path.points.front());
  for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
    const FaceId face = path.faceOfSegment[i];
    const double here = valueAt(mesh, field, path.points[i], face);
    const double next = valueAt(mesh, field, path.points[i + 1], face);
    parts.back().faceOfSegment.push_back(face);
    if ((here > 0) != (next > 0)) {
      const double t = here / (here - next);
      const Eigen::Vector3d weights = (1 - t) * barycentricIn(mesh, path.points[i], face) +
                                      t * barycentricIn(mesh, path.points[i + 1], face);
      const SurfacePoint border = makeSurfacePoint(mesh, face, weights);
      parts.back().points.push_back(border);
      parts.emplace_back();
      parts.back().points.push_back(border);
      parts.back().faceOfSegment.push_back(face);
    }
    parts.back().points.push_back(path.points[i + 1]);
  }
  return parts;
}

}  // namespace toile
