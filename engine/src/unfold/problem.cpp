// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/problem.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cut/topology.h"

namespace toile::unfolding {
namespace {

using std::numbers::pi;

/// A face lower than this share of its longest side has no plane of its own in double precision.
constexpr double kMinRelativeHeight = 1e-10;
/// Corners nearer to straight than this are points of a smooth line (notes: 0.5 rad).
constexpr double kSmoothTurn = 0.5;
/// The span of a corner is at least this share of the mean wire edge.
constexpr double kMinSpan = 0.05;
constexpr std::size_t kMaxNamed = 24;
/// A line that may shrink to a tenth says nothing any more.
constexpr double kMaxElasticRange = 0.9;

/// A face laid into a plane of its own: corner 0 at the origin, corner 1 along x, corner 2 above.
struct FlatFace {
  double length = 0;    ///< x of corner 1
  double x = 0, y = 0;  ///< of corner 2
  double longest = 0;   ///< side
  [[nodiscard]] double doubleArea() const { return length * y; }
};

FlatFace layFlat(const Piece& piece, FaceId f) {
  FlatFace face;
  if (!piece.targetSides.empty()) {
    const std::array<double, 3>& s = piece.targetSides[f];
    face.length = s[0];
    face.longest = *std::max_element(s.begin(), s.end());
    face.y = s[0] > 0 ? 2 * areaOf(s) / s[0] : 0;
    face.x = s[0] > 0 ? (s[0] * s[0] + (s[2] - s[1]) * (s[2] + s[1])) / (2 * s[0]) : 0;
    return face;
  }
  const Triangle& t = piece.mesh->vertices(f);
  const Eigen::Vector3d side = piece.mesh->position(t[1]) - piece.mesh->position(t[0]);
  const Eigen::Vector3d other = piece.mesh->position(t[2]) - piece.mesh->position(t[0]);
  face.length = side.norm();
  face.longest = std::max({face.length, other.norm(), (other - side).norm()});
  face.x = side.dot(other) / face.length;
  face.y = side.cross(other).norm() / face.length;
  return face;
}

/// The angle of a face at the corner that a halfedge leaves.
double angleAt(const Piece& piece, HalfedgeId h) {
  const Mesh& mesh = *piece.mesh;
  if (!piece.targetSides.empty()) {
    const FlatFace face = layFlat(piece, mesh.face(h));
    const std::array<Eigen::Vector2d, 3> at{
        Eigen::Vector2d(0, 0), {face.length, 0}, {face.x, face.y}};
    const auto k = static_cast<std::size_t>(mesh.side(h));
    const Eigen::Vector2d u = at[(k + 1) % 3] - at[k];
    const Eigen::Vector2d w = at[(k + 2) % 3] - at[k];
    return std::atan2(u.x() * w.y() - u.y() * w.x(), u.dot(w));
  }
  const Eigen::Vector3d u = mesh.position(mesh.to(h)) - mesh.position(mesh.from(h));
  const Eigen::Vector3d w =
      mesh.position(mesh.from(mesh.previous(h))) - mesh.position(mesh.from(h));
  return std::atan2(u.cross(w).norm(), u.dot(w));
}

Result<void> addTriangles(const Piece& piece, Problem& problem) {
  const Mesh& mesh = *piece.mesh;
  std::vector<Element> flat;
  problem.triangles.reserve(mesh.faceCount());
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.triangles()[f];
    const FlatFace face = layFlat(piece, FaceId(f));
    const auto& [length, x, y, longest] = face;
    const double doubleArea = face.doubleArea();
    if (!(doubleArea > kMinRelativeHeight * longest * longest)) {
      if (flat.size() < kMaxNamed) flat.push_back(Element::face(FaceId(f)));
      continue;
    }
    RestTriangle rest;
    rest.vertex = {t[0].index(), t[1].index(), t[2].index()};
    rest.area = 0.5 * doubleArea;
    rest.hatGradient = {Eigen::Vector2d(-y, x - length) / doubleArea,
                        Eigen::Vector2d(y, -x) / doubleArea,
                        Eigen::Vector2d(0, length) / doubleArea};
    problem.triangles.push_back(rest);
    problem.area += rest.area;
  }
  if (!flat.empty()) {
    return Error{ErrorCode::DegenerateFace,
                 fmt::format("{} face{} without area, the first is face {}; remove or repair them",
                             flat.size() == kMaxNamed ? "many" : fmt::format("{}", flat.size()),
                             flat.size() == 1 ? "" : "s",
                             piece.sourceFace[FaceId(flat.front().index)].index()),
                 flat};
  }
  return {};
}

Result<void> addLoops(const Mesh& mesh, Problem& problem) {
  const std::vector<cutting::LoopTurning> loops = cutting::measureLoops(mesh);
  std::vector<Element> where;
  for (const cutting::LoopTurning& loop : loops) {
    if (where.size() < kMaxNamed) where.push_back(Element::vertex(mesh.from(loop.halfedges[0])));
    auto& vertices = problem.loops.emplace_back();
    vertices.reserve(loop.halfedges.size());
    for (const HalfedgeId h : loop.halfedges) vertices.push_back(mesh.from(h).index());
  }
  const auto refuse = [&](std::string message) {
    return Error{ErrorCode::NotADisk, std::move(message), where};
  };
  if (loops.empty()) {
    return refuse("the surface is closed and cannot lie flat; cut it open along a line");
  }
  if (mesh.componentCount() != 1) {
    return refuse(fmt::format("the surface has {} separate parts; unfold them one by one",
                              mesh.componentCount()));
  }
  if (mesh.eulerCharacteristic() != 2 - static_cast<std::int64_t>(loops.size())) {
    return refuse("the surface has a handle; cut it open so that it can lie flat");
  }
  const auto holes = std::count_if(loops.begin(), loops.end(),
                                   [](const cutting::LoopTurning& loop) { return loop.isHole; });
  if (static_cast<std::size_t>(holes) + 1 != loops.size()) {
    return refuse(
        fmt::format("the surface is a tube with {} boundary loops; add a cut that joins "
                    "them",
                    loops.size()));
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!loops[i].isHole) problem.outerLoop = i;
  }
  return {};
}

/// The elastic line that a wire is a part of; all parts of a curve are one.
std::uint32_t elasticOf(const Wire& wire, Problem& problem) {
  if (wire.elasticRange == 0) return WireEdge::kNoWire;
  std::vector<Elastic>& all = problem.elastics;
  const auto known =
      std::find_if(all.begin(), all.end(), [&](const Elastic& e) { return e.curve == wire.curve; });
  if (known != all.end()) return static_cast<std::uint32_t>(known - all.begin());
  all.push_back({wire.curve, wire.elasticRange});
  return static_cast<std::uint32_t>(all.size() - 1);
}

/// The wire edge index of every mesh edge, kNoWire where there is none.
Result<EdgeData<std::uint32_t>> addWireEdges(const Piece& piece, Problem& problem) {
  const Mesh& mesh = *piece.mesh;
  EdgeData<std::uint32_t> wireOfEdge(mesh.edgeCount(), WireEdge::kNoWire);
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    if (wire.vertices.size() < 2 || wire.targetLength.size() + 1 != wire.vertices.size()) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("wire \"{}\" has {} vertices and {} lengths", wire.curve,
                               wire.vertices.size(), wire.targetLength.size()),
                   {Element::curve(wire.curve)}};
    }
    if (!(wire.elasticRange >= 0 && wire.elasticRange <= kMaxElasticRange)) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("wire \"{}\" has the elastic range {}; it must lie in 0..{}",
                               wire.curve, wire.elasticRange, kMaxElasticRange),
                   {Element::curve(wire.curve)}};
    }
    const std::uint32_t elastic = elasticOf(wire, problem);
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const EdgeId edge = mesh.findEdge(wire.vertices[i], wire.vertices[i + 1]);
      if (!edge.isValid()) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("wire \"{}\" leaves the mesh between its vertices {} and {}",
                                 wire.curve, i, i + 1),
                     {Element::curve(wire.curve), Element::vertex(wire.vertices[i])}};
      }
      const double target = wire.targetLength[i];
      if (!(target > 0) || !std::isfinite(target)) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("edge {} of wire \"{}\" has the target length {} mm; it must be a "
                                 "positive number",
                                 i, wire.curve, target),
                     {Element::curve(wire.curve), Element::edge(edge)}};
      }
      if (wireOfEdge[edge] != WireEdge::kNoWire) continue;  // two curves on one edge share it
      wireOfEdge[edge] = static_cast<std::uint32_t>(problem.wireEdges.size());
      problem.wireEdges.push_back({wire.vertices[i].index(), wire.vertices[i + 1].index(), target,
                                   static_cast<std::uint32_t>(w), static_cast<std::uint32_t>(i),
                                   !mesh.isBorder(edge), elastic});
    }
  }
  // A border that no wire names keeps its length on the surface.
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const EdgeId edge{e};
    if (!mesh.isBorder(edge) || wireOfEdge[edge] != WireEdge::kNoWire) continue;
    wireOfEdge[edge] = static_cast<std::uint32_t>(problem.wireEdges.size());
    problem.wireEdges.push_back({mesh.tail(edge).index(), mesh.head(edge).index(),
                                 mesh.length(edge), WireEdge::kNoWire, 0, false});
  }
  double sum = 0;
  for (const WireEdge& edge : problem.wireEdges) sum += edge.target;
  problem.meanWireEdge = sum / static_cast<double>(problem.wireEdges.size());
  return wireOfEdge;
}

/// Walks the faces around every wire vertex and closes a corner at each wire edge.
void addCorners(const Piece& piece, const EdgeData<std::uint32_t>& wireOfEdge, Problem& problem) {
  const Mesh& mesh = *piece.mesh;
  const auto isWire = [&](HalfedgeId h) { return wireOfEdge[mesh.edge(h)] != WireEdge::kNoWire; };
  const auto target = [&](HalfedgeId h) {
    return problem.wireEdges[wireOfEdge[mesh.edge(h)]].target;
  };
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    const VertexId v{i};
    HalfedgeId start = mesh.outgoing(v);
    if (!mesh.isBorder(v)) {
      const HalfedgeId first = start;
      while (!isWire(start)) {
        start = mesh.opposite(mesh.previous(start));
        if (start == first) break;
      }
      if (!isWire(start)) continue;
    }
    Corner corner;
    corner.at = v.index();
    HalfedgeId sectorStart = start;
    const auto openSector = [&](HalfedgeId h) {
      sectorStart = h;
      corner.before = mesh.to(h).index();
      corner.alpha = 0;
      corner.sectorBegin = static_cast<std::uint32_t>(problem.sectorCorners.size());
    };
    openSector(start);
    HalfedgeId h = start;
    do {
      const HalfedgeId incoming = mesh.previous(h);
      corner.alpha += angleAt(piece, h);
      problem.sectorCorners.push_back(h.index());
      h = mesh.opposite(incoming);
      if (!isWire(incoming)) continue;
      corner.after = mesh.from(incoming).index();
      corner.sectorEnd = static_cast<std::uint32_t>(problem.sectorCorners.size());
      if (corner.after != corner.before) {
        const bool smooth = std::abs(corner.alpha - pi) < kSmoothTurn;
        const double span = 0.5 * (target(sectorStart) + target(incoming));
        corner.span =
            smooth ? std::max(span, kMinSpan * problem.meanWireEdge) : problem.meanWireEdge;
        problem.corners.push_back(corner);
      }
      if (h.isValid()) openSector(h);
    } while (h.isValid() && h != start);
  }
}

}  // namespace

Result<Problem> makeProblem(const Piece& piece) {
  Problem problem;
  const Mesh& mesh = *piece.mesh;
  problem.vertexCount = mesh.vertexCount();
  if (Result<void> done = addLoops(mesh, problem); !done) return done.error();
  if (Result<void> done = addTriangles(piece, problem); !done) return done.error();
  Result<EdgeData<std::uint32_t>> wireOfEdge = addWireEdges(piece, problem);
  if (!wireOfEdge) return wireOfEdge.error();
  addCorners(piece, *wireOfEdge, problem);
  return problem;
}

void fixElastics(const Eigen::VectorXd& ratios, Problem& problem) {
  for (WireEdge& edge : problem.wireEdges) {
    if (edge.elastic == WireEdge::kNoWire) continue;
    edge.target *= 1 + ratios[edge.elastic];
    edge.elastic = WireEdge::kNoWire;
  }
  problem.elastics.clear();
}

}  // namespace toile::unfolding
