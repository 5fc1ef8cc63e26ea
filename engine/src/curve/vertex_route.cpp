// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/vertex_route.h"

#include <algorithm>
#include <limits>

namespace toile::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The vertices that see the point within a face.
std::vector<VertexId> cornersAround(const Mesh& mesh, const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) return {*v};
  std::vector<VertexId> corners;
  for (const FaceId face : facesOf(mesh, point)) {
    for (const VertexId v : mesh.vertices(face)) {
      if (std::find(corners.begin(), corners.end(), v) == corners.end()) corners.push_back(v);
    }
  }
  return corners;
}

bool isLater(const double boundA, VertexId a, const double boundB, VertexId b) {
  return boundA != boundB ? boundA > boundB : a > b;
}

/// The faces that hold both points; what matters is only which side of an edge they are.
std::vector<FaceId> commonFaces(const Mesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
  std::vector<FaceId> faces = facesOf(mesh, a);
  std::erase_if(faces, [&](FaceId f) { return !touches(mesh, b, f); });
  return faces;
}

/// Turns around a vertex in one direction until one of the goals is reached.
/// @return the angle of the faces passed on the way, infinite when a border bars it.
double turn(const Mesh& mesh, FaceGeometry& geometry, VertexId vertex, FaceId from,
            std::span<const FaceId> goals, bool counterClockwise, std::vector<HalfedgeId>& row) {
  int side = 0;
  while (mesh.vertices(from)[static_cast<std::size_t>(side)] != vertex) ++side;
  HalfedgeId leaving = mesh.halfedge(from, side);  // leaves the vertex
  double angle = 0;
  bool isFirst = true;
  while (std::find(goals.begin(), goals.end(), mesh.face(leaving)) == goals.end()) {
    if (!isFirst) angle += geometry.cornerAngle(leaving);
    isFirst = false;
    const HalfedgeId h = counterClockwise ? mesh.previous(leaving) : leaving;
    const HalfedgeId entered = mesh.opposite(h);
    if (!entered.isValid()) return kInfinity;
    row.push_back(h);
    leaving = counterClockwise ? entered : mesh.next(entered);
  }
  return angle;
}

}  // namespace

void appendTurn(const Mesh& mesh, FaceGeometry& geometry, VertexId vertex, FaceId from,
                std::span<const FaceId> goals, std::vector<HalfedgeId>& row) {
  if (std::find(goals.begin(), goals.end(), from) != goals.end()) return;
  const std::size_t before = row.size();
  const double leftAngle = turn(mesh, geometry, vertex, from, goals, true, row);
  std::vector<HalfedgeId> right;
  const double rightAngle = turn(mesh, geometry, vertex, from, goals, false, right);
  if (leftAngle <= rightAngle) return;
  row.resize(before);
  row.insert(row.end(), right.begin(), right.end());
}

VertexRoute::VertexRoute(const Mesh& mesh, FaceGeometry& geometry)
    : mesh_(mesh), geometry_(geometry), nodes_(mesh.vertexCount()) {}

void VertexRoute::offer(VertexId vertex, double cost, VertexId previous,
                        const Eigen::Vector3d& goal) {
  Node& node = nodes_[vertex.index()];
  if (node.run == run_ && (node.isDone || node.cost <= cost)) return;
  node = {cost, previous, run_, false};
  heap_.push_back({cost + (mesh_.position(vertex) - goal).norm(), vertex});
  std::push_heap(heap_.begin(), heap_.end(), [](const Candidate& a, const Candidate& b) {
    return isLater(a.bound, a.vertex, b.bound, b.vertex);
  });
}

std::vector<VertexId> VertexRoute::findVertices(const SurfacePoint& start,
                                                const SurfacePoint& end) {
  ++run_;
  heap_.clear();
  const Eigen::Vector3d from = position(mesh_, start), goal = position(mesh_, end);
  for (const VertexId v : cornersAround(mesh_, start)) {
    offer(v, (mesh_.position(v) - from).norm(), VertexId(), goal);
  }
  // The last stretch is straight, so the bound of a vertex that sees the end is its true cost.
  const std::vector<VertexId> last = cornersAround(mesh_, end);
  VertexId found;
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), [](const Candidate& a, const Candidate& b) {
      return isLater(a.bound, a.vertex, b.bound, b.vertex);
    });
    const VertexId v = heap_.back().vertex;
    heap_.pop_back();
    Node& node = nodes_[v.index()];
    if (node.isDone) continue;
    node.isDone = true;
    if (std::find(last.begin(), last.end(), v) != last.end()) {
      found = v;
      break;
    }
    const double cost = node.cost;
    const Eigen::Vector3d& place = mesh_.position(v);
    const HalfedgeId first = mesh_.outgoing(v);
    for (HalfedgeId h = first; h.isValid();) {
      const VertexId to = mesh_.to(h);
      offer(to, cost + (mesh_.position(to) - place).norm(), v, goal);
      const HalfedgeId incoming = mesh_.previous(h);
      h = mesh_.opposite(incoming);
      if (h == first) break;
      if (!h.isValid()) {  // the border edge at the end of the fan
        const VertexId other = mesh_.from(incoming);
        offer(other, cost + (mesh_.position(other) - place).norm(), v, goal);
      }
    }
  }
  std::vector<VertexId> route;
  for (VertexId v = found; v.isValid(); v = nodes_[v.index()].previous) route.push_back(v);
  std::reverse(route.begin(), route.end());
  return route;
}

std::optional<std::vector<HalfedgeId>> VertexRoute::find(const SurfacePoint& start,
                                                         const SurfacePoint& end) {
  const std::vector<VertexId> route = findVertices(start, end);
  if (route.empty()) return std::nullopt;

  std::vector<HalfedgeId> row;
  FaceId face;  // in which the way is
  for (std::size_t i = 0; i < route.size(); ++i) {
    const SurfacePoint here{route[i]};
    const SurfacePoint& next = i + 1 < route.size() ? SurfacePoint{route[i + 1]} : end;
    const std::vector<FaceId> goals = commonFaces(mesh_, here, next);
    if (!face.isValid()) face = commonFaces(mesh_, start, here).front();
    const std::size_t before = row.size();
    appendTurn(mesh_, geometry_, route[i], face, goals, row);
    if (row.size() > before) face = mesh_.face(mesh_.opposite(row.back()));
  }
  return row;
}

}  // namespace toile::detail
