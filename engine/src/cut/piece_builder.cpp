// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/piece_builder.h"

#include <algorithm>
#include <numeric>

namespace toile::cutting {
namespace {

/// Corners 3f + k of a region's faces, merged where faces meet at an edge that stays closed. Around
/// a vertex that gives one class per fan between cuts, whether a cut passes, ends or branches
/// there.
class CornerClasses {
 public:
  explicit CornerClasses(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The class is named by its smallest corner.
  void merge(std::size_t i, std::size_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

bool isOpened(const RefinedMesh& refined, EdgeId edge) {
  const CutEdgeId id = refined.cutEdge[edge];
  return id.isValid() && isBoundary(refined.cutEdges[id.index()].kind);
}

std::vector<std::vector<FaceId>> findRegions(const RefinedMesh& refined) {
  const Mesh& mesh = refined.mesh;
  std::vector<std::vector<FaceId>> regions;
  std::vector<bool> isVisited(mesh.faceCount(), false);
  for (std::size_t seed = 0; seed < mesh.faceCount(); ++seed) {
    if (isVisited[seed]) continue;
    isVisited[seed] = true;
    std::vector<FaceId>& region = regions.emplace_back(1, FaceId(seed));
    for (std::size_t i = 0; i < region.size(); ++i) {
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId h = mesh.halfedge(region[i], side);
        if (isOpened(refined, mesh.edge(h)) || !mesh.opposite(h).isValid()) continue;
        const FaceId neighbour = mesh.face(mesh.opposite(h));
        if (isVisited[neighbour.index()]) continue;
        isVisited[neighbour.index()] = true;
        region.push_back(neighbour);
      }
    }
    std::sort(region.begin(), region.end());
  }
  return regions;
}

Result<PieceBuild> buildPiece(const RefinedMesh& refined, std::span<const FaceId> region,
                              const VertexData<std::uint32_t>& openedAt,
                              std::span<const PlacedCurve> curves) {
  const Mesh& mesh = refined.mesh;
  const auto localFace = [&](FaceId f) {
    return static_cast<std::size_t>(std::lower_bound(region.begin(), region.end(), f) -
                                    region.begin());
  };
  CornerClasses classes(3 * region.size());
  for (std::size_t f = 0; f < region.size(); ++f) {
    for (int side = 0; side < 3; ++side) {
      const HalfedgeId h = mesh.halfedge(region[f], side);
      const HalfedgeId twin = mesh.opposite(h);
      if (!twin.isValid() || twin < h || isOpened(refined, mesh.edge(h))) continue;
      const auto k = static_cast<std::size_t>(side);
      const std::size_t g = 3 * localFace(mesh.face(twin));
      const auto l = static_cast<std::size_t>(mesh.side(twin));
      classes.merge(3 * f + k, g + (l + 1) % 3);
      classes.merge(3 * f + (k + 1) % 3, g + l);
    }
  }

  // By where they lie on the model; the sides of a cut by the piece's faces.
  std::vector<std::pair<VertexId, std::size_t>> vertices;
  for (std::size_t c = 0; c < 3 * region.size(); ++c) {
    if (classes.find(c) == c) vertices.emplace_back(mesh.vertices(region[c / 3])[c % 3], c);
  }
  std::sort(vertices.begin(), vertices.end());
  std::vector<VertexId> vertexOfClass(3 * region.size());
  std::vector<Eigen::Vector3d> positions;
  PieceBuild build;
  build.piece.onModel = VertexData<SurfacePoint>(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    vertexOfClass[vertices[v].second] = VertexId(v);
    positions.push_back(mesh.position(vertices[v].first));
    build.piece.onModel[VertexId(v)] = refined.onModel[vertices[v].first];
  }
  std::vector<Triangle> triangles(region.size());
  build.piece.sourceFace = FaceData<FaceId>(region.size());
  for (std::size_t f = 0; f < region.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangles[f][k] = vertexOfClass[classes.find(3 * f + k)];
    }
    build.piece.sourceFace[FaceId(f)] = refined.sourceFace[region[f]];
  }
  Result<Mesh> opened = makeMesh(std::move(positions), std::move(triangles));
  if (!opened) return opened.error().during("opening the model along its seams");
  build.piece.mesh = std::make_shared<const Mesh>(std::move(*opened));
  build.refinedFace.assign(region.begin(), region.end());
  addWires(build, refined, openedAt, curves);
  return build;
}

}  // namespace toile::cutting
