// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "develop/patch.h"

namespace toile {
namespace developing {
namespace {

/// Barycentric weights of a place in the plane of a face.
Eigen::Vector3d weightsIn(const Mesh& mesh, FaceId face, const Eigen::Vector3d& place) {
  const Triangle& t = mesh.vertices(face);
  const Eigen::Vector3d u = mesh.position(t[1]) - mesh.position(t[0]);
  const Eigen::Vector3d w = mesh.position(t[2]) - mesh.position(t[0]);
  const Eigen::Vector3d p = place - mesh.position(t[0]);
  const Eigen::Vector3d normal = u.cross(w);
  const double b = p.cross(w).dot(normal) / normal.squaredNorm();
  const double c = u.cross(p).dot(normal) / normal.squaredNorm();
  return {1 - b - c, b, c};
}

}  // namespace

Patch patchOf(const Piece& piece) {
  Patch patch{*piece.mesh, {}, {}, {}};
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    PolygonSoup::Chain chain{fmt::format("wire_{}_{}", toString(wire.kind), w), {}, 0};
    for (const VertexId v : wire.vertices) chain.vertices.push_back(v.index());
    for (std::size_t i = 0; i < wire.targetLength.size(); ++i) {
      patch.targets[fmt::format("{} {}", chain.group, i)] = wire.targetLength[i];
    }
    patch.chains.push_back(std::move(chain));
  }
  return patch;
}

void takeTargetSides(const Piece& from, const FaceData<FaceId>& source, Piece& to) {
  if (from.targetSides.empty()) return;
  const Mesh& mesh = *to.mesh;
  to.targetSides = FaceData<std::array<double, 3>>(mesh.faceCount());
  double bodyArea = 0, targetArea = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    // Squared length of a vector w in the face, given by weights that sum to 0:
    // -(w0 w1 s0^2 + w1 w2 s1^2 + w2 w0 s2^2), s = the face's sides.
    const FaceId whole = source[FaceId(f)];
    const std::array<double, 3>& s = from.targetSides[whole];
    std::array<Eigen::Vector3d, 3> weights;
    for (std::size_t k = 0; k < 3; ++k) {
      weights[k] = weightsIn(*from.mesh, whole, mesh.position(mesh.vertices(FaceId(f))[k]));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d w = weights[(k + 1) % 3] - weights[k];
      to.targetSides[FaceId(f)][k] =
          std::sqrt(std::max(0.0, -(w[0] * w[1] * s[0] * s[0] + w[1] * w[2] * s[1] * s[1] +
                                    w[2] * w[0] * s[2] * s[2])));
    }
    bodyArea += mesh.area(FaceId(f));
    targetArea += areaOf(to.targetSides[FaceId(f)]);
  }
  const double scale = std::sqrt(targetArea / bodyArea);
  for (Wire& wire : to.wires) {
    if (wire.kind != WireKind::Dart || !wire.curve.starts_with(kProposal)) continue;
    for (double& target : wire.targetLength) target *= scale;
  }
}

Result<std::vector<Piece>> partsOf(const Piece& piece) {
  const Mesh& mesh = *piece.mesh;
  constexpr std::uint32_t kNone = 0xffffffffU;
  FaceData<std::uint32_t> partOf(mesh.faceCount(), kNone);
  std::vector<std::vector<FaceId>> faces;
  for (std::size_t seed = 0; seed < mesh.faceCount(); ++seed) {
    if (partOf[FaceId(seed)] != kNone) continue;
    const auto part = static_cast<std::uint32_t>(faces.size());
    partOf[FaceId(seed)] = part;
    std::vector<FaceId>& own = faces.emplace_back(1, FaceId(seed));
    for (std::size_t i = 0; i < own.size(); ++i) {
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId other = mesh.opposite(mesh.halfedge(own[i], side));
        if (!other.isValid() || partOf[mesh.face(other)] != kNone) continue;
        partOf[mesh.face(other)] = part;
        own.push_back(mesh.face(other));
      }
    }
    std::sort(own.begin(), own.end());
  }
  std::vector<Piece> parts;
  for (const std::vector<FaceId>& own : faces) {
    VertexData<VertexId> number(mesh.vertexCount());
    std::vector<Eigen::Vector3d> positions;
    std::vector<Triangle> triangles;
    Piece part;
    part.name = piece.name;
    for (const FaceId f : own) {
      Triangle& triangle = triangles.emplace_back(mesh.vertices(f));
      for (VertexId& v : triangle) {
        if (!number[v].isValid()) {
          number[v] = VertexId(positions.size());
          positions.push_back(mesh.position(v));
        }
        v = number[v];
      }
      if (!piece.targetSides.empty()) part.targetSides.values().push_back(piece.targetSides[f]);
    }
    for (const Wire& wire : piece.wires) {
      if (wire.vertices.empty() || !number[wire.vertices.front()].isValid()) continue;
      Wire& mine = part.wires.emplace_back(wire);
      for (VertexId& v : mine.vertices) v = number[v];
    }
    Result<Mesh> shape = makeMesh(std::move(positions), std::move(triangles));
    if (!shape) return shape.error();
    part.mesh = std::make_shared<const Mesh>(*std::move(shape));
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace developing

namespace {

/// The path on another mesh with the same faces, whose vertices may be parted or joined.
SurfacePath onSameFaces(const Mesh& from, const SurfacePath& path, const Mesh& to) {
  SurfacePath moved = path;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const FaceId face = path.faceOfSegment[std::min(i, path.faceOfSegment.size() - 1)];
    moved.points[i] = makeSurfacePoint(to, face, barycentricIn(from, path.points[i], face));
  }
  return moved;
}

}  // namespace

Result<Patch> addDarts(const Patch& patch, const Piece& piece, std::span<const SurfacePath> paths,
                       std::span<const std::string> ids) {
  std::vector<PlacedCurve> darts;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    darts.push_back({ids[i], CurveKind::Dart, {}, onSameFaces(*piece.mesh, paths[i], patch.mesh)});
  }
  Result<RefinedMesh> refined = refine(patch.mesh, darts);
  if (!refined) return refined.error();
  const Mesh& mesh = refined->mesh;
  Patch with{mesh, patch.chains, patch.targets, refined->sourceFace};
  if (!patch.sourceFace.empty()) {
    for (FaceId& source : with.sourceFace.values()) source = patch.sourceFace[source];
  }
  for (std::size_t i = 0; i < darts.size(); ++i) {
    // The edges of the cut, in order from the mouth: each vertex has one behind it and one ahead.
    std::vector<std::vector<std::uint32_t>> neighbours(mesh.vertexCount());
    for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
      const CutEdgeId cutEdge = refined->cutEdge[EdgeId(e)];
      if (!cutEdge.isValid()) continue;
      const CutEdge& edge = refined->cutEdges[cutEdge.index()];
      if (edge.kind != WireKind::Dart || edge.curve != i) continue;
      neighbours[mesh.tail(EdgeId(e)).index()].push_back(mesh.head(EdgeId(e)).index());
      neighbours[mesh.head(EdgeId(e)).index()].push_back(mesh.tail(EdgeId(e)).index());
    }
    const auto* mouth = std::get_if<VertexId>(&darts[i].path.points.front().at);
    if (mouth == nullptr || neighbours[mouth->index()].size() != 1) {
      return Error{ErrorCode::CurveInvalid, "a dart must begin at a vertex of the boundary", {}};
    }
    PolygonSoup::Chain chain{"wire_dart_" + ids[i], {mouth->index()}, 0};
    for (std::uint32_t before = mouth->index(), at = neighbours[before].front();;) {
      chain.vertices.push_back(at);
      if (chain.vertices.size() > mesh.vertexCount()) {
        return Error{ErrorCode::CurveInvalid, "the dart \"" + ids[i] + "\" meets itself", {}};
      }
      if (neighbours[at].size() < 2) break;
      const std::uint32_t next =
          neighbours[at][0] == before ? neighbours[at][1] : neighbours[at][0];
      before = std::exchange(at, next);
    }
    with.chains.push_back(std::move(chain));
  }
  return with;
}

}  // namespace toile
