// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace toile {

namespace {

constexpr std::size_t kMaxNamedElements = 24;

/// A halfedge with the vertices of its edge, smaller index first.
struct DirectedSide {
  VertexId tail;
  VertexId head;
  HalfedgeId halfedge;
  bool fromTail = true;
};

/// By tail, head and halfedge: counted into place by tail, of which each has few.
std::vector<DirectedSide> sortedSides(const std::vector<Triangle>& triangles,
                                      std::size_t vertexCount) {
  std::vector<std::uint32_t> end(vertexCount + 1, 0);
  const auto forEachSide = [&](const auto& visit) {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = triangles[f][k];
        const VertexId b = triangles[f][(k + 1) % 3];
        visit(DirectedSide{std::min(a, b), std::max(a, b), HalfedgeId(3 * f + k), a < b});
      }
    }
  };
  forEachSide([&](const DirectedSide& side) { ++end[side.tail.index() + 1]; });
  for (std::size_t v = 0; v < vertexCount; ++v) end[v + 1] += end[v];
  std::vector<DirectedSide> sides(3 * triangles.size());
  std::vector<std::uint32_t> next(end.begin(), end.end() - 1);
  forEachSide([&](const DirectedSide& side) { sides[next[side.tail.index()]++] = side; });
  const auto at = [&](std::uint32_t i) { return sides.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t v = 0; v < vertexCount; ++v) {
    std::sort(at(end[v]), at(end[v + 1]), [](const DirectedSide& x, const DirectedSide& y) {
      return x.head != y.head ? x.head < y.head : x.halfedge < y.halfedge;
    });
  }
  return sides;
}

std::string edgeName(VertexId a, VertexId b) {
  return std::to_string(a.index()) + "-" + std::to_string(b.index());
}

/// Collects offenders of one kind: the first few for `where`, all of them for the count.
struct Offenders {
  std::vector<Element> where;
  std::string first;
  std::size_t count = 0;

  void add(std::initializer_list<Element> elements, const std::string& name) {
    if (count++ == 0) first = name;
    if (where.size() < kMaxNamedElements) where.insert(where.end(), elements);
  }
};

Result<void> checkInput(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Triangle>& triangles) {
  if (triangles.empty()) {
    return Error{ErrorCode::InvalidArgument, "the mesh has no face; give one with triangles", {}};
  }
  std::vector<bool> isUsed(positions.size(), false);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto [a, b, c] = triangles[f];
    for (const VertexId v : triangles[f]) {
      if (v.index() >= positions.size()) {
        return Error{ErrorCode::InvalidArgument,
                     "face " + std::to_string(f) + " names vertex " + std::to_string(v.index()) +
                         ", but there are only " + std::to_string(positions.size()),
                     {Element::face(FaceId(f))}};
      }
      isUsed[v.index()] = true;
    }
    if (a == b || b == c || c == a) {
      return Error{ErrorCode::DegenerateFace,
                   "face " + std::to_string(f) + " names a vertex twice; remove it",
                   {Element::face(FaceId(f))}};
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!isUsed[v]) {
      return Error{ErrorCode::InvalidArgument,
                   "vertex " + std::to_string(v) + " belongs to no face; remove it",
                   {Element::vertex(VertexId(v))}};
    }
    if (!positions[v].allFinite()) {
      return Error{ErrorCode::InvalidArgument,
                   "vertex " + std::to_string(v) + " has a coordinate that is not a finite number",
                   {Element::vertex(VertexId(v))}};
    }
  }
  return {};
}

/// The halfedges of one fan around a vertex, counter-clockwise.
template <class Visit>
void forEachOutgoing(const Mesh& mesh, VertexId v, const Visit& visit) {
  const HalfedgeId start = mesh.outgoing(v);
  HalfedgeId h = start;
  do {
    visit(h);
    h = mesh.opposite(mesh.previous(h));
  } while (h.isValid() && h != start);
}

}  // namespace

VertexId Mesh::tail(EdgeId e) const {
  const HalfedgeId h = halfedge(e);
  return std::min(from(h), to(h));
}

VertexId Mesh::head(EdgeId e) const {
  const HalfedgeId h = halfedge(e);
  return std::max(from(h), to(h));
}

std::vector<FaceId> Mesh::facesAround(VertexId v) const {
  std::vector<FaceId> faces;
  forEachOutgoing(*this, v, [&](HalfedgeId h) { faces.push_back(face(h)); });
  return faces;
}

EdgeId Mesh::findEdge(VertexId a, VertexId b) const {
  // Edges are numbered by (tail, head).
  const VertexId wantedTail = std::min(a, b);
  const VertexId wantedHead = std::max(a, b);
  std::size_t low = 0;
  std::size_t high = edgeCount();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const EdgeId e(middle);
    const VertexId t = tail(e);
    if (t < wantedTail || (t == wantedTail && head(e) < wantedHead)) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low == edgeCount()) return {};
  const EdgeId e(low);
  return tail(e) == wantedTail && head(e) == wantedHead ? e : EdgeId();
}

double Mesh::length(EdgeId e) const {
  // From tail to head always, so that every asker gets the same bits.
  return (position(head(e)) - position(tail(e))).norm();
}

double Mesh::area(FaceId f) const {
  const auto& [a, b, c] = vertices(f);
  return 0.5 * (position(b) - position(a)).cross(position(c) - position(a)).norm();
}

Eigen::Vector3d Mesh::normal(FaceId f) const {
  const auto& [a, b, c] = vertices(f);
  const Eigen::Vector3d cross = (position(b) - position(a)).cross(position(c) - position(a));
  const double norm = cross.norm();
  return norm > 0 ? Eigen::Vector3d(cross / norm) : Eigen::Vector3d::Zero();
}

std::vector<std::vector<HalfedgeId>> Mesh::boundaryLoops() const {
  std::vector<std::vector<HalfedgeId>> loops;
  std::vector<bool> isVisited(halfedgeCount(), false);
  for (std::size_t i = 0; i < halfedgeCount(); ++i) {
    if (isVisited[i] || opposite_[i].isValid()) continue;
    std::vector<HalfedgeId>& loop = loops.emplace_back();
    HalfedgeId h(i);
    do {
      isVisited[h.index()] = true;
      loop.push_back(h);
      h = outgoing(to(h));
    } while (h != HalfedgeId(i));
  }
  return loops;
}

std::size_t Mesh::componentCount() const {
  std::size_t count = 0;
  std::vector<bool> isVisited(faceCount(), false);
  std::vector<FaceId> stack;
  for (std::size_t seed = 0; seed < faceCount(); ++seed) {
    if (isVisited[seed]) continue;
    ++count;
    isVisited[seed] = true;
    stack.assign(1, FaceId(seed));
    while (!stack.empty()) {
      const FaceId f = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = opposite(halfedge(f, k));
        if (!h.isValid() || isVisited[face(h).index()]) continue;
        isVisited[face(h).index()] = true;
        stack.push_back(face(h));
      }
    }
  }
  return count;
}

std::int64_t Mesh::eulerCharacteristic() const {
  return static_cast<std::int64_t>(vertexCount()) - static_cast<std::int64_t>(edgeCount()) +
         static_cast<std::int64_t>(faceCount());
}

Mesh Mesh::withPositions(std::vector<Eigen::Vector3d> positions) const {
  TOILE_ASSERT(positions.size() == positions_.size());
  Mesh mesh = *this;
  mesh.positions_ = std::move(positions);
  mesh.measure();
  return mesh;
}

void Mesh::measure() {
  boxMin_ = boxMax_ = positions_.front();
  for (const Eigen::Vector3d& p : positions_) {
    boxMin_ = boxMin_.cwiseMin(p);
    boxMax_ = boxMax_.cwiseMax(p);
  }
  double sum = 0;
  for (std::size_t e = 0; e < edgeCount(); ++e) sum += length(EdgeId(e));
  meanEdgeLength_ = sum / static_cast<double>(edgeCount());
}

Result<Mesh> makeMesh(std::vector<Eigen::Vector3d> positions, std::vector<Triangle> triangles) {
  if (const Result<void> input = checkInput(positions, triangles); !input) return input.error();

  Mesh mesh;
  mesh.positions_ = std::move(positions);
  mesh.triangles_ = std::move(triangles);
  mesh.opposite_.assign(mesh.halfedgeCount(), HalfedgeId());
  mesh.halfedgeEdge_.assign(mesh.halfedgeCount(), EdgeId());

  Offenders branching;
  Offenders turned;
  const std::vector<DirectedSide> sides = sortedSides(mesh.triangles_, mesh.vertexCount());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].tail == sides[i].tail &&
           sides[end].head == sides[i].head) {
      ++end;
    }
    const EdgeId e(mesh.edgeHalfedge_.size());
    const std::size_t first = end - i == 2 && !sides[i].fromTail ? i + 1 : i;
    mesh.edgeHalfedge_.push_back(sides[first].halfedge);
    for (std::size_t k = i; k < end; ++k) mesh.halfedgeEdge_[sides[k].halfedge.index()] = e;
    const std::initializer_list<Element> ends = {Element::vertex(sides[i].tail),
                                                 Element::vertex(sides[i].head)};
    if (end - i > 2) {
      branching.add(ends, edgeName(sides[i].tail, sides[i].head));
    } else if (end - i == 2) {
      if (sides[i].fromTail == sides[i + 1].fromTail) {
        turned.add(ends, edgeName(sides[i].tail, sides[i].head));
      } else {
        mesh.opposite_[sides[i].halfedge.index()] = sides[i + 1].halfedge;
        mesh.opposite_[sides[i + 1].halfedge.index()] = sides[i].halfedge;
      }
    }
    i = end;
  }
  if (branching.count > 0) {
    return Error{ErrorCode::NotManifold,
                 std::to_string(branching.count) +
                     " edge(s) belong to more than two faces, the first between vertices " +
                     branching.first + "; split the parts that touch there or remove the inner one",
                 branching.where};
  }
  if (turned.count > 0) {
    return Error{ErrorCode::NotOrientable,
                 "the faces on the two sides of " + std::to_string(turned.count) +
                     " edge(s) are oriented against each other, the first between vertices " +
                     turned.first + "; turn the faces so that outside is counter-clockwise",
                 turned.where};
  }

  std::vector<std::uint32_t> outgoingCount(mesh.vertexCount(), 0);
  mesh.outgoing_.assign(mesh.vertexCount(), HalfedgeId());
  for (std::size_t i = 0; i < mesh.halfedgeCount(); ++i) {
    const HalfedgeId h(i);
    const std::size_t v = mesh.from(h).index();
    ++outgoingCount[v];
    const bool isFirst = !mesh.outgoing_[v].isValid();
    if (isFirst || !mesh.opposite(h).isValid()) mesh.outgoing_[v] = h;
  }
  Offenders pinched;
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    std::uint32_t fan = 0;
    forEachOutgoing(mesh, VertexId(v), [&fan](HalfedgeId) { ++fan; });
    if (fan != outgoingCount[v]) {
      pinched.add({Element::vertex(VertexId(v))}, std::to_string(v));
    }
  }
  if (pinched.count > 0) {
    return Error{ErrorCode::NotManifold,
                 std::to_string(pinched.count) +
                     " vertex(es) join parts that touch only there, the first is vertex " +
                     pinched.first + "; give each part a vertex of its own",
                 pinched.where};
  }

  ContentHasher hasher;
  hasher.add(std::uint64_t{mesh.vertexCount()}).add(std::uint64_t{mesh.faceCount()});
  static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
  hasher.bytes(mesh.triangles_.data(), mesh.triangles_.size() * sizeof(Triangle));
  mesh.connectivityHash_ = hasher.finish();
  mesh.measure();
  return mesh;
}

}  // namespace toile
