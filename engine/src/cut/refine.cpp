// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cut/cut_at.h"
#include "cut/face_segments.h"
#include "cut/face_triangulation.h"
#include "cut/joined_ends.h"
#include "toile/core/parallel.h"
#include "toile/cut/cut.h"

namespace toile {
namespace {

using cutting::FaceFrame;
using cutting::kUnit;
using cutting::LatticePoint;
using cutting::LocalEdge;
using cutting::LocalTriangle;
using cutting::Node;
using cutting::NodeTable;
using cutting::Owner;
using cutting::Segment;

/// Each round hands nodes on from one face to its neighbours; a few are usual.
constexpr int kMaxRounds = 100;

constexpr std::array<WireKind, 5> kKindByRank{WireKind::Seam, WireKind::Opening, WireKind::Dart,
                                              WireKind::Elastic, WireKind::Feature};

std::uint8_t rankOf(CurveKind kind) {
  switch (kind) {
    case CurveKind::Seam:
      return 0;
    case CurveKind::Opening:
      return 1;
    case CurveKind::Dart:
      return 2;
    case CurveKind::Elastic:
      return 3;
    case CurveKind::Feature:
    case CurveKind::Mark:
    case CurveKind::Guide:
      break;
  }
  return 4;
}

/// A point of a curve as whole numbers, before it is a node.
Node roundToLattice(const SurfacePoint& point) {
  constexpr auto kParts = static_cast<double>(kUnit);
  if (const auto* v = std::get_if<VertexId>(&point.at)) return Node::vertex(*v);
  if (const auto* e = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    return Node::edge(e->edge, std::llround(e->t * kParts));
  }
  const auto& in = std::get<SurfacePoint::InFace>(point.at);
  const std::int64_t b1 =
      std::clamp<std::int64_t>(std::llround(in.barycentric[1] * kParts), 0, kUnit);
  const std::int64_t b2 =
      std::clamp<std::int64_t>(std::llround(in.barycentric[2] * kParts), 0, kUnit - b1);
  return Node::face(in.face, b1, b2);
}

class Refiner {
 public:
  Refiner(const Mesh& mesh, std::span<const PlacedCurve> curves,
          std::span<const SurfacePoint> points)
      : mesh_(mesh), curves_(curves), points_(points), table_(mesh), inFace_(mesh.faceCount()) {}

  Result<RefinedMesh> run() {
    if (auto placed = placeSegments(); !placed) return placed.error();
    placePoints();
    if (auto settled = settle(); !settled) return settled.error();
    numberNodes();
    if (splitLoneCuts()) numberNodes();
    return build();
  }

 private:
  /// Curve points become nodes in the order of where they lie, not of who drew them.
  Result<void> placeSegments() {
    for (const PlacedCurve& curve : curves_) {
      if (isWire(curve.kind) && !isValid(mesh_, curve.path)) {
        return Error{ErrorCode::CurveInvalid,
                     "curve \"" + curve.id + "\" does not lie on this model; draw it again",
                     {Element::curve(curve.id)}};
      }
    }
    const std::vector<SurfacePath> paths = cutting::withJoinedEnds(mesh_, curves_);
    std::vector<Node> rounded;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      if (!isWire(curves_[c].kind)) continue;
      for (const SurfacePoint& point : paths[c].points) rounded.push_back(roundToLattice(point));
    }
    std::vector<Node> sorted = rounded;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<Node> nodes;
    nodes.reserve(sorted.size());
    for (const Node& at : sorted) nodes.push_back(insert(at));

    std::size_t next = 0;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      if (!isWire(curves_[c].kind)) continue;
      const SurfacePath& path = paths[c];
      const std::size_t count = path.points.size();
      std::vector<Node> chain;
      for (std::size_t i = 0; i < count; ++i) {
        const auto found = std::lower_bound(sorted.begin(), sorted.end(), rounded[next++]);
        chain.push_back(nodes[static_cast<std::size_t>(found - sorted.begin())]);
      }
      for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
        inFace_[path.faceOfSegment[i].index()].push_back(
            cutting::makeSegment(chain[i], chain[i + 1 < count ? i + 1 : 0],
                                 rankOf(curves_[c].kind), static_cast<std::uint32_t>(c)));
      }
    }
    return {};
  }

  void placePoints() {
    std::vector<Node> sorted;
    for (const SurfacePoint& point : points_) sorted.push_back(roundToLattice(point));
    std::sort(sorted.begin(), sorted.end());
    // A node moves at most as far as segments are led through nodes, so that it stays on its curve.
    for (const Node& at : sorted) insert(at, 0.5 * kMergeDistanceMm);
  }

  Node insert(const Node& at, double tolerance = kMergeDistanceMm) {
    switch (at.kind) {
      case Node::Kind::Vertex:
        return at;
      case Node::Kind::Edge:
        return table_.insertOnEdge(EdgeId(at.element), at.p, tolerance);
      case Node::Kind::Face:
        break;
    }
    const FaceFrame frame(mesh_, FaceId(at.element));
    return table_.insertInFace(frame, {at.p, at.q}, tolerance);
  }

  /// Faces by rounds, because a node that one puts on an edge concerns the other. Which faces wait
  /// in a round depends on their surroundings alone.
  Result<void> settle() {
    table_.takeChangedEdges();
    std::vector<FaceId> waiting;
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      if (!inFace_[f].empty()) waiting.emplace_back(f);
    }
    for (int round = 0; round < kMaxRounds && !waiting.empty(); ++round) {
      std::vector<FaceId> next;
      for (const FaceId f : waiting) {
        const FaceFrame frame(mesh_, f);
        std::vector<Segment>& segments = inFace_[f.index()];
        if (!settleSegments(frame, table_, segments, alongEdges_, kMergeDistanceMm)) {
          return restless(f);
        }
        for (const EdgeId e : table_.takeChangedEdges()) {
          const HalfedgeId h = mesh_.halfedge(e);
          for (const HalfedgeId side : {h, mesh_.opposite(h)}) {
            if (side.isValid() && mesh_.face(side) != f) next.push_back(mesh_.face(side));
          }
        }
      }
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      waiting = std::move(next);
    }
    if (!waiting.empty()) return restless(waiting.front());
    return {};
  }

  [[nodiscard]] Error restless(FaceId f) const {
    Error error{ErrorCode::CurveInvalid, "", {Element::face(f)}};
    std::string names;
    for (const Segment& s : inFace_[f.index()]) {
      const std::string& id = curves_[s.owner.curve].id;
      if (names.find('"' + id + '"') != std::string::npos) continue;
      names += (names.empty() ? "\"" : ", \"") + id + '"';
      error.where.push_back(Element::curve(id));
    }
    error.message = "curves " + names + " are too tangled in face " + std::to_string(f.index()) +
                    "; move them apart or repair the face";
    return error;
  }

  /// A cut of a single edge with both ends free could not be opened, for its two sides would run
  /// between the same two vertices: it gets a node in its middle.
  bool splitLoneCuts() {
    splitAlongEdges();
    std::vector<std::uint32_t> cutsAt(nodes_.size(), 0);
    const auto visitCuts = [&](const std::vector<Segment>& segments, const auto& visit) {
      for (std::size_t i = 0; i < segments.size(); ++i) {
        if (isBoundary(kKindByRank[segments[i].owner.rank])) visit(i);
      }
    };
    const auto count = [&](const std::vector<Segment>& segments) {
      visitCuts(segments, [&](std::size_t i) {
        ++cutsAt[vertexOf(segments[i].a).index()];
        ++cutsAt[vertexOf(segments[i].b).index()];
      });
    };
    const auto endsFreely = [&](const Node& node) {
      return cutsAt[vertexOf(node).index()] == 1 && !isOnBorder(node);
    };
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < inFace_.size(); ++f) {
      if (!inFace_[f].empty()) faces.emplace_back(f);
    }
    for (const FaceId f : faces) count(inFace_[f.index()]);
    count(alongEdges_);

    std::vector<std::pair<FaceId, std::size_t>> lone;
    for (const FaceId f : faces) {
      visitCuts(inFace_[f.index()], [&](std::size_t i) {
        const Segment& s = inFace_[f.index()][i];
        if (endsFreely(s.a) && endsFreely(s.b)) lone.emplace_back(f, i);
      });
    }
    std::vector<std::size_t> loneAlongEdges;
    visitCuts(alongEdges_, [&](std::size_t i) {
      if (endsFreely(alongEdges_[i].a) && endsFreely(alongEdges_[i].b)) loneAlongEdges.push_back(i);
    });
    for (const auto& [f, i] : lone) {
      const FaceFrame frame(mesh_, f);
      const LatticePoint a = frame.lattice(inFace_[f.index()][i].a);
      const LatticePoint b = frame.lattice(inFace_[f.index()][i].b);
      const Node middle = table_.insertInFace(frame, {(a.x + b.x) / 2, (a.y + b.y) / 2}, 0);
      splitSegment(inFace_[f.index()], i, middle);
    }
    for (const std::size_t i : loneAlongEdges) {
      const auto [edge, low, high] = placeOnEdge(alongEdges_[i]);
      splitSegment(alongEdges_, i, table_.insertOnEdge(edge, (low + high) / 2, 0));
    }
    return !lone.empty() || !loneAlongEdges.empty();
  }

  [[nodiscard]] bool isOnBorder(const Node& node) const {
    if (node.kind == Node::Kind::Vertex) return mesh_.isBorder(VertexId(node.element));
    return node.kind == Node::Kind::Edge && mesh_.isBorder(EdgeId(node.element));
  }

  static void splitSegment(std::vector<Segment>& segments, std::size_t i, const Node& middle) {
    const Segment whole = segments[i];
    const Owner& owner = whole.owner;
    const Node& from = owner.backward ? whole.b : whole.a;
    const Node& to = owner.backward ? whole.a : whole.b;
    segments[i] = cutting::makeSegment(from, middle, owner.rank, owner.curve);
    segments.push_back(cutting::makeSegment(middle, to, owner.rank, owner.curve));
  }

  void numberNodes() {
    firstOnEdge_.clear();
    firstInFace_.clear();
    nodes_.clear();
    std::size_t count = mesh_.vertexCount();
    for (std::size_t e = 0; e < mesh_.edgeCount(); ++e) {
      firstOnEdge_.push_back(count);
      count += table_.onEdge(EdgeId(e)).size();
    }
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      firstInFace_.push_back(count);
      count += table_.inFace(FaceId(f)).size();
    }
    nodes_.reserve(count);
    for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) {
      nodes_.push_back(Node::vertex(VertexId(v)));
    }
    for (std::size_t e = 0; e < mesh_.edgeCount(); ++e) {
      for (const std::uint32_t t : table_.onEdge(EdgeId(e))) {
        nodes_.push_back(Node::edge(EdgeId(e), t));
      }
    }
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      for (const auto& [p, q] : table_.inFace(FaceId(f))) {
        nodes_.push_back(Node::face(FaceId(f), p, q));
      }
    }
  }

  [[nodiscard]] VertexId vertexOf(const Node& node) const {
    std::size_t rank = node.element;
    if (node.kind == Node::Kind::Edge) {
      const auto& nodes = table_.onEdge(EdgeId(node.element));
      rank = firstOnEdge_[node.element] +
             static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node.p) -
                                      nodes.begin());
    } else if (node.kind == Node::Kind::Face) {
      const auto& nodes = table_.inFace(FaceId(node.element));
      const auto found = std::lower_bound(nodes.begin(), nodes.end(), std::pair{node.p, node.q});
      rank = firstInFace_[node.element] + static_cast<std::size_t>(found - nodes.begin());
    }
    return VertexId(rank);
  }

  [[nodiscard]] bool staysWhole(FaceId f) const {
    const auto isSplit = [&](int side) {
      return !table_.onEdge(mesh_.edge(mesh_.halfedge(f, side))).empty();
    };
    return table_.inFace(f).empty() && !isSplit(0) && !isSplit(1) && !isSplit(2);
  }

  Result<std::vector<Triangle>> refineFace(FaceId f) const {
    const FaceFrame frame(mesh_, f);
    std::vector<Node> nodes = table_.nodesOf(frame);
    std::sort(nodes.begin(), nodes.end());
    std::vector<LatticePoint> points;
    for (const Node& node : nodes) points.push_back(frame.lattice(node));
    const auto indexOf = [&](const Node& node) {
      return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                        nodes.begin());
    };
    std::vector<LocalEdge> edges;
    for (const Segment& s : inFace_[f.index()]) edges.emplace_back(indexOf(s.a), indexOf(s.b));
    Result<std::vector<LocalTriangle>> triangulated = cutting::triangulate(points, edges);
    if (!triangulated) {
      return triangulated.error().during("face " + std::to_string(f.index()));
    }
    makeDelaunay(frame, points, edges, *triangulated);
    std::vector<Triangle> triangles;
    for (LocalTriangle t : *triangulated) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      triangles.push_back({vertexOf(nodes[t[0]]), vertexOf(nodes[t[1]]), vertexOf(nodes[t[2]])});
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }

  Result<RefinedMesh> build() {
    std::vector<FaceId> split;
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      if (!staysWhole(FaceId(f))) split.emplace_back(f);
    }
    std::vector<std::optional<Result<std::vector<Triangle>>>> refined(split.size());
    parallelFor(split.size(), [&](std::size_t i) { refined[i] = refineFace(split[i]); });
    std::vector<Triangle> triangles;
    std::vector<FaceId> sources;
    triangles.reserve(mesh_.faceCount() + 6 * split.size());
    sources.reserve(mesh_.faceCount() + 6 * split.size());
    std::size_t next = 0;
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f) {
      if (next == split.size() || split[next] != FaceId(f)) {
        triangles.push_back(mesh_.vertices(FaceId(f)));
        sources.emplace_back(f);
        continue;
      }
      const Result<std::vector<Triangle>>& parts = *refined[next++];
      if (!parts) return parts.error();
      triangles.insert(triangles.end(), parts->begin(), parts->end());
      sources.insert(sources.end(), parts->size(), FaceId(f));
    }
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(nodes_.size());
    VertexData<SurfacePoint> onModel(nodes_.size());
    for (std::size_t v = 0; v < nodes_.size(); ++v) {
      positions.push_back(cutting::position(mesh_, nodes_[v]));
      onModel[VertexId(v)] = cutting::surfacePoint(nodes_[v]);
    }
    Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
    if (!mesh) return mesh.error().during("refining along the curves");
    RefinedMesh result{std::move(*mesh), std::move(onModel), {}, {}, {}};
    result.sourceFace = FaceData<FaceId>(sources.size());
    result.sourceFace.values() = std::move(sources);
    nameCutEdges(result);
    return result;
  }

  struct EdgeSpan {
    EdgeId edge;
    std::int64_t low = 0;  ///< parts from the tail
    std::int64_t high = 0;
  };

  [[nodiscard]] EdgeSpan placeOnEdge(const Segment& s) const {
    EdgeId edge;
    for (const Node& node : {s.a, s.b}) {
      if (node.kind == Node::Kind::Edge) edge = EdgeId(node.element);
    }
    if (!edge.isValid()) edge = mesh_.findEdge(VertexId(s.a.element), VertexId(s.b.element));
    const auto place = [&](const Node& node) -> std::int64_t {
      if (node.kind == Node::Kind::Edge) return node.p;
      return node.element == mesh_.tail(edge).index() ? 0 : kUnit;
    };
    const auto [low, high] = std::minmax({place(s.a), place(s.b)});
    return {edge, low, high};
  }

  /// Splits what runs along mesh edges at every node there.
  void splitAlongEdges() {
    std::vector<Segment> parts;
    for (const Segment& s : alongEdges_) {
      const auto [edge, low, high] = placeOnEdge(s);
      const auto isLow = [edge = edge, low = low, this](const Node& node) {
        return node.kind == Node::Kind::Edge ? node.p == low
                                             : low == 0 && node.element == mesh_.tail(edge).index();
      };
      std::vector<Node> chain{isLow(s.a) ? s.a : s.b};
      for (const std::uint32_t t : table_.onEdge(edge)) {
        if (low < t && t < high) chain.push_back(Node::edge(edge, t));
      }
      chain.push_back(isLow(s.a) ? s.b : s.a);
      if (isLow(s.a) == s.owner.backward) std::reverse(chain.begin(), chain.end());
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        parts.push_back(cutting::makeSegment(chain[i], chain[i + 1], s.owner.rank, s.owner.curve));
      }
    }
    alongEdges_ = std::move(parts);
    cutting::mergeSegments(alongEdges_);
  }

  void nameCutEdges(RefinedMesh& result) {
    std::vector<Segment> all = std::move(alongEdges_);
    for (const std::vector<Segment>& segments : inFace_) {
      all.insert(all.end(), segments.begin(), segments.end());
    }
    cutting::mergeSegments(all);
    const Mesh& mesh = result.mesh;
    EdgeData<std::optional<Owner>> owner(mesh.edgeCount());
    for (const Segment& s : all) {
      // Nodes and vertices have the same order: a is the tail.
      const EdgeId e = mesh.findEdge(vertexOf(s.a), vertexOf(s.b));
      TOILE_ASSERT(e.isValid());
      owner[e] = s.owner;
    }
    result.cutEdge = EdgeData<CutEdgeId>(mesh.edgeCount());
    for (std::size_t i = 0; i < mesh.edgeCount(); ++i) {
      const EdgeId e(i);
      CutEdge cutEdge{mesh.length(e), mesh.length(e), WireKind::Border, kNoCurve, false};
      if (!mesh.isBorder(e)) {
        if (!owner[e]) continue;
        cutEdge.kind = kKindByRank[owner[e]->rank];
        cutEdge.curve = owner[e]->curve;
        cutEdge.backward = owner[e]->backward;
      }
      result.cutEdge[e] = CutEdgeId(result.cutEdges.size());
      result.cutEdges.push_back(cutEdge);
    }
  }

  const Mesh& mesh_;
  std::span<const PlacedCurve> curves_;
  std::span<const SurfacePoint> points_;
  NodeTable table_;
  std::vector<std::vector<Segment>> inFace_;  ///< by face
  std::vector<Segment> alongEdges_;
  std::vector<std::size_t> firstOnEdge_;  ///< vertex number of an edge's first node
  std::vector<std::size_t> firstInFace_;
  std::vector<Node> nodes_;  ///< by vertex number
};

}  // namespace

Result<RefinedMesh> refine(const Mesh& mesh, std::span<const PlacedCurve> curves) {
  return cutting::refineAt(mesh, curves, {});
}

Result<RefinedMesh> cutting::refineAt(const Mesh& mesh, std::span<const PlacedCurve> curves,
                                      std::span<const SurfacePoint> points) {
  return Refiner(mesh, curves, points).run();
}

}  // namespace toile
