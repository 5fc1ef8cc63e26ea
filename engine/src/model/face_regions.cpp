// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/face_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "toile/core/assert.h"

namespace toile::detail {
namespace {

std::uint32_t regionCount(const FaceRegions& regions) {
  if (regions.empty()) return 0;
  return 1 + *std::max_element(regions.values().begin(), regions.values().end());
}

}  // namespace

FaceData<FaceId> mirroredFaces(const ReferenceModel& model) {
  const Mesh& mesh = *model.mesh;
  if (!model.symmetry || model.symmetry->partner.empty()) return {};
  const VertexData<VertexId>& partner = model.symmetry->partner;
  FaceData<FaceId> out(mesh.faceCount());
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const Triangle& t = mesh.vertices(FaceId(i));
    // The mirror image of halfedge a -> b runs from b' to a'.
    const VertexId from = partner[t[1]];
    const VertexId to = partner[t[0]];
    const EdgeId edge = mesh.findEdge(from, to);
    if (!edge.isValid()) return {};
    HalfedgeId h = mesh.halfedge(edge);
    if (mesh.from(h) != from) h = mesh.opposite(h);
    if (!h.isValid() || mesh.to(mesh.next(h)) != partner[t[2]]) return {};
    out[FaceId(i)] = mesh.face(h);
  }
  return out;
}

FaceRegions connectedFaces(const Mesh& mesh, const std::function<bool(EdgeId)>& isBorder) {
  constexpr std::uint32_t kNone = ~0U;
  FaceRegions regions(mesh.faceCount(), kNone);
  std::uint32_t count = 0;
  std::vector<FaceId> open;
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    if (regions[FaceId(i)] != kNone) continue;
    open.assign(1, FaceId(i));
    regions[FaceId(i)] = count;
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId h = mesh.halfedge(f, side);
        const HalfedgeId twin = mesh.opposite(h);
        if (!twin.isValid() || regions[mesh.face(twin)] != kNone || isBorder(mesh.edge(h)))
          continue;
        regions[mesh.face(twin)] = count;
        open.push_back(mesh.face(twin));
      }
    }
    ++count;
  }
  return regions;
}

FaceRegions mergedParts(const Mesh& mesh, const FaceRegions& regions, double share) {
  constexpr int kMostRounds = 16;
  FaceRegions out = regions;
  for (int round = 0; round < kMostRounds; ++round) {
    const auto isBorder = [&](EdgeId e) {
      const HalfedgeId h = mesh.halfedge(e);
      return out[mesh.face(h)] != out[mesh.face(mesh.opposite(h))];
    };
    const FaceRegions parts = connectedFaces(mesh, isBorder);
    const std::uint32_t partCount = regionCount(parts);
    std::vector<double> area(partCount, 0);
    std::vector<std::uint32_t> regionOf(partCount, 0);
    double whole = 0;
    for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
      const FaceId f(i);
      area[parts[f]] += mesh.area(f);
      whole += mesh.area(f);
      regionOf[parts[f]] = out[f];
    }
    std::vector<double> largest(regionCount(out), 0);
    for (std::uint32_t p = 0; p < partCount; ++p)
      largest[regionOf[p]] = std::max(largest[regionOf[p]], area[p]);
    // Mirrored halves are equal but for rounding and stay both or go both.
    constexpr double kEqual = 1 - 1e-6;
    const auto stays = [&](std::uint32_t p) {
      return area[p] >= share * whole && area[p] >= kEqual * largest[regionOf[p]];
    };
    std::vector<std::map<std::uint32_t, double>> shared(partCount);
    for (std::size_t i = 0; i < mesh.edgeCount(); ++i) {
      const EdgeId e(i);
      if (mesh.isBorder(e)) continue;
      const HalfedgeId h = mesh.halfedge(e);
      const FaceId a = mesh.face(h);
      const FaceId b = mesh.face(mesh.opposite(h));
      if (parts[a] == parts[b]) continue;
      if (stays(parts[b])) shared[parts[a]][out[b]] += mesh.length(e);
      if (stays(parts[a])) shared[parts[b]][out[a]] += mesh.length(e);
    }
    std::vector<std::uint32_t> goesTo = regionOf;
    bool changed = false;
    for (std::uint32_t p = 0; p < partCount; ++p) {
      if (stays(p) || shared[p].empty()) continue;
      const auto most = std::max_element(
          shared[p].begin(), shared[p].end(),
          [](const auto& a, const auto& b) { return a.second < kEqual * b.second; });
      changed = changed || most->first != regionOf[p];
      goesTo[p] = most->first;
    }
    if (!changed) break;
    for (std::size_t i = 0; i < mesh.faceCount(); ++i) out[FaceId(i)] = goesTo[parts[FaceId(i)]];
  }
  return out;
}

FaceRegions tidyRegions(const Mesh& mesh, const FaceRegions& regions, double share) {
  const FaceRegions merged = mergedParts(mesh, regions, share);
  return connectedFaces(mesh, [&](EdgeId e) {
    const HalfedgeId h = mesh.halfedge(e);
    return merged[mesh.face(h)] != merged[mesh.face(mesh.opposite(h))];
  });
}

FaceRegions regionsBySharpTurns(const Mesh& mesh) {
  constexpr double kSharpCosine = 0.5;  // turns of more than 60 degrees
  constexpr double kLeastShare = 0.02;
  const FaceRegions raw = connectedFaces(mesh, [&](EdgeId e) {
    const HalfedgeId h = mesh.halfedge(e);
    return mesh.normal(mesh.face(h)).dot(mesh.normal(mesh.face(mesh.opposite(h)))) < kSharpCosine;
  });
  return tidyRegions(mesh, raw, kLeastShare);
}

FaceRegions regionsBetween(const Mesh& mesh, std::span<const SurfacePath> borders) {
  constexpr double kLeastShare = 1e-4;  // slivers between a border and itself
  // Vertices are joined along edges that no border crosses; a face follows most of its corners.
  std::vector<char> isCrossed(mesh.edgeCount(), 0);
  std::vector<char> isOnBorder(mesh.vertexCount(), 0);
  for (const SurfacePath& path : borders) {
    for (const SurfacePoint& p : path.points) {
      if (const auto* v = std::get_if<VertexId>(&p.at)) isOnBorder[v->index()] = 1;
      if (const auto* e = std::get_if<SurfacePoint::OnEdge>(&p.at)) isCrossed[e->edge.index()] = 1;
    }
  }
  constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> label(mesh.vertexCount(), kNone);
  std::uint32_t count = 0;
  std::vector<VertexId> open;
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    if (label[i] != kNone || isOnBorder[i] != 0) continue;
    label[i] = count;
    open.assign(1, VertexId(i));
    while (!open.empty()) {
      const VertexId v = open.back();
      open.pop_back();
      for (const FaceId f : mesh.facesAround(v)) {
        for (const VertexId w : mesh.vertices(f)) {
          if (w == v || label[w.index()] != kNone || isOnBorder[w.index()] != 0 ||
              isCrossed[mesh.findEdge(v, w).index()] != 0)
            continue;
          label[w.index()] = count;
          open.push_back(w);
        }
      }
    }
    ++count;
  }
  FaceRegions regions(mesh.faceCount(), count);
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    std::array<std::uint32_t, 3> of{};
    for (std::size_t k = 0; k < 3; ++k) of[k] = label[mesh.vertices(FaceId(i))[k].index()];
    std::sort(of.begin(), of.end());
    const std::uint32_t most = of[1] != kNone ? (of[1] == of[2] ? of[1] : of[0]) : of[0];
    if (most != kNone) regions[FaceId(i)] = most;
  }
  return tidyRegions(mesh, regions, kLeastShare);
}

}  // namespace toile::detail
