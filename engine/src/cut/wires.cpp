// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "cut/piece_builder.h"

namespace toile::cutting {
namespace {

class WireFinder {
 public:
  WireFinder(PieceBuild& build, const RefinedMesh& refined,
             const VertexData<std::uint32_t>& openedAt, std::span<const PlacedCurve> curves)
      : build_(build),
        mesh_(*build.piece.mesh),
        refined_(refined),
        openedAt_(openedAt),
        curves_(curves) {}

  void run() {
    for (const std::vector<HalfedgeId>& loop : mesh_.boundaryLoops()) addLoop(loop);
    addInnerWires();
  }

 private:
  [[nodiscard]] HalfedgeId inRefined(HalfedgeId h) const {
    return refined_.mesh.halfedge(build_.refinedFace[mesh_.face(h).index()], mesh_.side(h));
  }
  [[nodiscard]] CutEdgeId cutEdge(HalfedgeId h) const {
    return refined_.cutEdge[refined_.mesh.edge(inRefined(h))];
  }
  [[nodiscard]] const CutEdge& cutEdgeOf(HalfedgeId h) const {
    return refined_.cutEdges[cutEdge(h).index()];
  }
  [[nodiscard]] bool isSameCurve(HalfedgeId g, HalfedgeId h) const {
    return cutEdgeOf(g).kind == cutEdgeOf(h).kind && cutEdgeOf(g).curve == cutEdgeOf(h).curve;
  }

  /// Where a wire begins is told from the refined mesh alone: the other side of the seam finds the
  /// same places.
  void addLoop(std::vector<HalfedgeId> loop) {
    const std::size_t count = loop.size();
    const auto place = [&](std::size_t i) { return refined_.mesh.from(inRefined(loop[i])); };
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < count; ++i) {
      const bool isJunction =
          openedAt_[place(i)] != 2 || !isSameCurve(loop[(i + count - 1) % count], loop[i]);
      if (isJunction) starts.push_back(i);
    }
    const auto byPlace = [&](std::size_t i, std::size_t j) {
      return std::pair{place(i), mesh_.from(loop[i])} < std::pair{place(j), mesh_.from(loop[j])};
    };
    std::size_t first = 0;
    if (starts.empty()) {
      for (std::size_t i = 1; i < count; ++i) first = byPlace(i, first) ? i : first;
      starts.push_back(first);
    } else {
      first = *std::min_element(starts.begin(), starts.end(), byPlace);
    }
    for (std::size_t& start : starts) start = (start + count - first) % count;
    std::sort(starts.begin(), starts.end());
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
    for (std::size_t s = 0; s < starts.size(); ++s) {
      const std::size_t end = s + 1 < starts.size() ? starts[s + 1] : count;
      addWire({loop.begin() + static_cast<std::ptrdiff_t>(starts[s]),
               loop.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }

  void addWire(const std::vector<HalfedgeId>& halfedges) {
    const CutEdge& kept = cutEdgeOf(halfedges.front());
    Wire wire;
    wire.kind = kept.kind;
    wire.curve = kept.curve == kNoCurve ? "border" : curves_[kept.curve].id;
    wire.part = runs_[wire.curve]++;
    wire.vertices.push_back(mesh_.from(halfedges.front()));
    std::vector<HalfedgeId>& inRefinedMesh = build_.wireHalfedges.emplace_back();
    for (const HalfedgeId h : halfedges) {
      wire.vertices.push_back(mesh_.to(h));
      wire.bodyLength.push_back(cutEdgeOf(h).bodyLength);
      wire.targetLength.push_back(cutEdgeOf(h).targetLength);
      wire.cutEdges.push_back(cutEdge(h));
      inRefinedMesh.push_back(inRefined(h));
    }
    build_.piece.wires.push_back(std::move(wire));
  }

  /// One of the two directions of an inner edge per entry, by the vertex it leaves.
  void collectInnerEdges() {
    leaving_.assign(mesh_.vertexCount(), {});
    for (std::size_t i = 0; i < mesh_.edgeCount(); ++i) {
      const HalfedgeId h = mesh_.halfedge(EdgeId(i));
      if (mesh_.isBorder(EdgeId(i)) || !cutEdge(h).isValid()) continue;
      for (const HalfedgeId side : {h, mesh_.opposite(h)}) {
        leaving_[mesh_.from(side).index()].push_back(side);
      }
    }
  }

  [[nodiscard]] bool endsWireAt(VertexId v) const {
    const std::vector<HalfedgeId>& leaving = leaving_[v.index()];
    return leaving.size() != 2 || mesh_.isBorder(v) || !isSameCurve(leaving[0], leaving[1]);
  }

  [[nodiscard]] bool isAlongCurve(HalfedgeId h) const {
    const HalfedgeId r = inRefined(h);
    const bool fromTail = refined_.mesh.from(r) < refined_.mesh.to(r);
    return fromTail != cutEdgeOf(h).backward;
  }

  void addInnerWires() {
    collectInnerEdges();
    std::vector<bool> isDone(mesh_.edgeCount(), false);
    const auto follow = [&](HalfedgeId h) {
      std::vector<HalfedgeId> chain;
      while (true) {
        chain.push_back(h);
        isDone[mesh_.edge(h).index()] = true;
        const VertexId v = mesh_.to(h);
        if (endsWireAt(v)) break;
        const std::vector<HalfedgeId>& leaving = leaving_[v.index()];
        const HalfedgeId next = mesh_.edge(leaving[0]) == mesh_.edge(h) ? leaving[1] : leaving[0];
        if (isDone[mesh_.edge(next).index()]) break;
        h = next;
      }
      const auto along =
          std::count_if(chain.begin(), chain.end(), [&](HalfedgeId c) { return isAlongCurve(c); });
      if (2 * static_cast<std::size_t>(along) < chain.size()) {
        std::reverse(chain.begin(), chain.end());
        for (HalfedgeId& c : chain) c = mesh_.opposite(c);
      }
      addWire(chain);
    };
    for (const bool fromEnds : {true, false}) {  // then closed ones, from their smallest vertex
      for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) {
        if (fromEnds && !endsWireAt(VertexId(v))) continue;
        for (const HalfedgeId h : leaving_[v]) {
          if (!isDone[mesh_.edge(h).index()]) follow(h);
        }
      }
    }
  }

  PieceBuild& build_;
  const Mesh& mesh_;
  const RefinedMesh& refined_;
  const VertexData<std::uint32_t>& openedAt_;
  std::span<const PlacedCurve> curves_;
  std::map<std::string, int> runs_;
  std::vector<std::vector<HalfedgeId>> leaving_;
};

}  // namespace

void addWires(PieceBuild& build, const RefinedMesh& refined,
              const VertexData<std::uint32_t>& openedAt, std::span<const PlacedCurve> curves) {
  WireFinder(build, refined, openedAt, curves).run();
}

std::vector<SeamMates> findMates(const RefinedMesh& refined, std::span<const PieceBuild> builds) {
  struct Place {
    std::uint32_t piece = 0;
    std::uint32_t wire = 0;
    auto operator<=>(const Place&) const = default;
  };
  HalfedgeData<std::optional<Place>> placeOf(refined.mesh.halfedgeCount());
  const auto forEachSewn = [&](const auto& visit) {
    for (std::uint32_t p = 0; p < builds.size(); ++p) {
      if (!builds[p].piece.include) continue;
      for (std::uint32_t w = 0; w < builds[p].piece.wires.size(); ++w) {
        const WireKind kind = builds[p].piece.wires[w].kind;
        if (kind == WireKind::Seam || kind == WireKind::Dart) {
          visit(Place{p, w}, builds[p].wireHalfedges[w]);
        }
      }
    }
  };
  forEachSewn([&](Place place, const std::vector<HalfedgeId>& halfedges) {
    for (const HalfedgeId h : halfedges) placeOf[h] = place;
  });
  std::vector<SeamMates> mates;
  forEachSewn([&](Place place, const std::vector<HalfedgeId>& halfedges) {
    const std::optional<Place> other = placeOf[refined.mesh.opposite(halfedges.front())];
    if (!other || !(place < *other)) return;
    const auto& theirs = builds[other->piece].wireHalfedges[other->wire];
    TOILE_ASSERT(theirs.size() == halfedges.size());
    TOILE_ASSERT(refined.mesh.opposite(theirs.back()) == halfedges.front());
    mates.push_back({place.piece, place.wire, other->piece, other->wire});
  });
  return mates;
}

}  // namespace toile::cutting
