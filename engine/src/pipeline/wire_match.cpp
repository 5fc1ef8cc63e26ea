// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/wire_match.h"

#include "model/mirror.h"

namespace toile {

WireMatch::WireMatch(const ReferenceModel& model, const Piece& original, const Piece& twin)
    : model_(model), original_(original), twin_(twin) {
  for (std::size_t w = 0; w < twin.wires.size(); ++w) {
    const std::vector<VertexId>& v = twin.wires[w].vertices;
    for (std::size_t e = 0; e + 1 < v.size(); ++e) {
      byEnds_.emplace(std::pair(carrierOf(twin.onModel[v[e]]), carrierOf(twin.onModel[v[e + 1]])),
                      EdgeOfWire{w, e});
    }
  }
  for (std::size_t v = 0; v < original.onModel.size(); ++v) {
    images_.push_back(
        detail::mirrored(*model.mesh, model.symmetry->partner, original.onModel[VertexId(v)]));
  }
}

std::optional<std::vector<std::vector<EdgeOfWire>>> WireMatch::find() const {
  std::vector<std::vector<EdgeOfWire>> originalOf;
  std::size_t missing = 0;
  for (const Wire& wire : twin_.wires) {
    originalOf.emplace_back(wire.vertices.size() - 1);
    missing += wire.vertices.size() - 1;
  }
  for (std::size_t w = 0; w < original_.wires.size(); ++w) {
    const Wire& wire = original_.wires[w];
    for (std::size_t e = 0; e + 1 < wire.vertices.size(); ++e) {
      // With the piece on the left both outlines run the same way, so images run backward; inner
      // lines may do either.
      bool isBackward = true;
      auto image = imageOf(wire.vertices[e + 1], wire.vertices[e]);
      if (!image && !isBoundary(wire.kind)) {
        isBackward = false;
        image = imageOf(wire.vertices[e], wire.vertices[e + 1]);
      }
      if (!image) return std::nullopt;
      originalOf[image->wire][image->edge] = {w, e, isBackward};
      --missing;
    }
  }
  return missing == 0 ? std::optional(std::move(originalOf)) : std::nullopt;
}

WireMatch::Carrier WireMatch::carrierOf(const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) return {0, v->index()};
  if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at)) return {1, on->edge.index()};
  return {2, std::get<SurfacePoint::InFace>(point.at).face.index()};
}

std::optional<EdgeOfWire> WireMatch::imageOf(VertexId from, VertexId to) const {
  const SurfacePoint& a = images_[from.index()];
  const SurfacePoint& b = images_[to.index()];
  const auto [begin, end] = byEnds_.equal_range({carrierOf(a), carrierOf(b)});
  for (auto it = begin; it != end; ++it) {
    const Wire& wire = twin_.wires[it->second.wire];
    const std::size_t e = it->second.edge;
    if (isAt(a, wire.vertices[e]) && isAt(b, wire.vertices[e + 1])) return it->second;
  }
  return std::nullopt;
}

bool WireMatch::isAt(const SurfacePoint& point, VertexId v) const {
  return (position(*model_.mesh, point) - position(*model_.mesh, twin_.onModel[v])).norm() <
         kMergeDistanceMm;
}

void copyTargets(const RefinedMesh& refined, std::vector<Piece>& pieces) {
  for (Piece& piece : pieces) {
    for (Wire& wire : piece.wires) {
      for (std::size_t e = 0; e < wire.cutEdges.size(); ++e) {
        wire.targetLength[e] = refined.cutEdges[wire.cutEdges[e].index()].targetLength;
      }
    }
  }
}

}  // namespace toile
