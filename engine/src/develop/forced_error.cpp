// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "develop/curvature_potential.h"
#include "develop/wire_vertices.h"
#include "toile/develop/darts.h"

namespace toile {
namespace developing {

EdgeData<char> wireEdges(const Piece& piece) {
  const Mesh& mesh = *piece.mesh;
  EdgeData<char> isWire(mesh.edgeCount(), 0);
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    if (mesh.isBorder(EdgeId(e))) isWire[EdgeId(e)] = 1;
  }
  for (const Wire& wire : piece.wires) {
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const EdgeId edge = mesh.findEdge(wire.vertices[i], wire.vertices[i + 1]);
      if (edge.isValid()) isWire[edge] = 1;
    }
  }
  return isWire;
}

VertexData<char> wireVertices(const Mesh& mesh, const EdgeData<char>& isWire) {
  VertexData<char> onWire(mesh.vertexCount(), 0);
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    if (isWire[EdgeId(e)] == 0) continue;
    onWire[mesh.tail(EdgeId(e))] = onWire[mesh.head(EdgeId(e))] = 1;
  }
  return onWire;
}

}  // namespace developing

namespace {

using namespace developing;

EdgeData<double> targetLengths(const Piece& piece) {
  const Mesh& mesh = *piece.mesh;
  EdgeData<double> target(mesh.edgeCount());
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) target[EdgeId(e)] = mesh.length(EdgeId(e));
  for (const Wire& wire : piece.wires) {
    for (std::size_t i = 0; i < wire.targetLength.size(); ++i) {
      const EdgeId edge = mesh.findEdge(wire.vertices[i], wire.vertices[i + 1]);
      if (edge.isValid()) target[edge] = wire.targetLength[i];
    }
  }
  return target;
}

/// Sum over the regions between wires of the area that no plane of their outlines' length holds,
/// as a share of the whole area.
double isoperimetricBound(const Piece& piece, const EdgeData<char>& isWire) {
  const Mesh& mesh = *piece.mesh;
  const EdgeData<double> target = targetLengths(piece);
  FaceData<char> visited(mesh.faceCount(), 0);
  double lost = 0, total = 0;
  for (std::size_t seed = 0; seed < mesh.faceCount(); ++seed) {
    if (visited[FaceId(seed)] != 0) continue;
    std::vector<FaceId> region{FaceId(seed)};
    visited[FaceId(seed)] = 1;
    double area = 0, outline = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
      area += areaOf(targetSides(piece, region[i]));
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId h = mesh.halfedge(region[i], side);
        if (isWire[mesh.edge(h)] != 0) {
          outline += target[mesh.edge(h)];
          continue;
        }
        const FaceId next = mesh.face(mesh.opposite(h));
        if (visited[next] != 0) continue;
        visited[next] = 1;
        region.push_back(next);
      }
    }
    total += area;
    lost += std::max(0.0, area - outline * outline / (4 * std::numbers::pi));
  }
  return lost / total;
}

}  // namespace

Result<ForcedError> measureForcedError(const Piece& piece) {
  const Mesh& mesh = *piece.mesh;
  const EdgeData<char> isWire = wireEdges(piece);
  const VertexData<char> onWire = wireVertices(mesh, isWire);
  if (std::none_of(onWire.values().begin(), onWire.values().end(), [](char c) { return c != 0; })) {
    return Error{ErrorCode::NotADisk, "a closed surface cannot lie flat; cut it open first", {}};
  }
  ForcedError forced;
  forced.bound = isoperimetricBound(piece, isWire);
  const FreeVertices inner(mesh);
  forced.totalCurvature = defects(mesh, inner, mesh.positions()).sum();
  const VertexData<double> potential = curvaturePotential(mesh, FreeVertices(mesh, onWire));
  forced.estimate = areaErrorOf(mesh, potential);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    if (forced.apex.isValid() && std::abs(potential[VertexId(v)]) <= std::abs(forced.bulge)) {
      continue;
    }
    forced.apex = VertexId(v);
    forced.bulge = potential[VertexId(v)];
  }
  return forced;
}

}  // namespace toile
