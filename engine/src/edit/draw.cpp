// SPDX-License-Identifier: GPL-3.0-or-later
// New curves by points and by what the model has.
#include "toile/edit/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <queue>

#include "edit/parts.h"
#include "toile/curve/crossing.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;

namespace {

StylingCurve begun(const NewCurve& curve, CurveWay way, bool closed) {
  StylingCurve made;
  made.id = curve.id;
  made.name = curve.name;
  made.kind = curve.kind;
  made.closed = closed;
  made.way = std::move(way);
  return made;
}

/// Adds a curve that is given by its way and puts it on the model; its data points are noted,
/// unless it is to go on hanging on others.
Result<Edited> addByWay(const Document& document, StylingCurve curve, bool keepsHanging = false) {
  Sketch sketch(document);
  const CurveWay way = curve.way;
  const Result<std::string> id = sketch.add(std::move(curve));
  if (!id) return id.error();
  const Result<WorkCurve> work = sketch.load(*id);
  if (!work) return work.error();
  if (!keepsHanging) {
    sketch.store(*id, *work);
    sketch.edit(*id).way = way;
  }
  return Edited{sketch.document(), {*id}, {}};
}

Result<std::vector<Place>> placesOf(const Document& document,
                                    std::span<const SurfacePoint> points) {
  std::vector<Place> places;
  for (const SurfacePoint& point : points) {
    if (!isValid(*document.model->mesh, point)) {
      return Error{
          ErrorCode::CurveInvalid,
          fmt::format("point {} of the curve does not lie on the model", places.size() + 1),
          {}};
    }
    places.emplace_back(toModelPoint(*document.model->mesh, point));
  }
  return places;
}

/// The shortest way along mesh edges, without its first vertex.
Result<std::vector<VertexId>> edgesTo(const Mesh& mesh, VertexId from, VertexId to) {
  struct Candidate {
    double cost;
    VertexId vertex;
    bool operator<(const Candidate& other) const {
      return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
  };
  VertexData<double> cost(mesh.vertexCount(), std::numeric_limits<double>::infinity());
  VertexData<VertexId> previous(mesh.vertexCount());
  std::priority_queue<Candidate> waiting;
  cost[from] = 0;
  waiting.push({0, from});
  while (!waiting.empty()) {
    const Candidate next = waiting.top();
    waiting.pop();
    if (next.vertex == to) break;
    if (next.cost > cost[next.vertex]) continue;
    for (const FaceId face : mesh.facesAround(next.vertex)) {
      for (const VertexId v : mesh.vertices(face)) {
        const double through = next.cost + (mesh.position(v) - mesh.position(next.vertex)).norm();
        if (v == next.vertex || through >= cost[v]) continue;
        cost[v] = through;
        previous[v] = next.vertex;
        waiting.push({through, v});
      }
    }
  }
  if (!previous[to].isValid()) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("no edges lead from vertex {} to vertex {}", from.index(), to.index()),
                 {Element::vertex(from), Element::vertex(to)}};
  }
  std::vector<VertexId> row;
  for (VertexId v = to; v != from; v = previous[v]) row.push_back(v);
  std::reverse(row.begin(), row.end());
  return row;
}

}  // namespace

Result<Edited> drawThrough(const Document& document, std::span<const SurfacePoint> points,
                           bool closed, const NewCurve& curve) {
  Result<std::vector<Place>> places = placesOf(document, points);
  if (!places) return places.error();
  return addByWay(document, begun(curve, SmoothWay{*std::move(places)}, closed));
}

Result<Edited> drawShortest(const Document& document, std::span<const SurfacePoint> points,
                            const NewCurve& curve) {
  Result<std::vector<Place>> places = placesOf(document, points);
  if (!places) return places.error();
  return addByWay(document, begun(curve, ShortestWay{*std::move(places)}, false));
}

Result<Edited> drawGirth(const Document& document, const SurfacePoint& through,
                         const Eigen::Vector3d& normal, const NewCurve& curve) {
  const Result<std::vector<Place>> place = placesOf(document, std::span(&through, 1));
  if (!place) return place.error();
  AlongSection way;
  way.plane.normal = normal;
  way.plane.through = std::get<ModelPoint>(place->front());
  // Where the model is open the loop may be a line.
  Result<Edited> closed = addByWay(document, begun(curve, way, true));
  return closed ? closed : addByWay(document, begun(curve, way, false));
}

Result<Edited> drawDart(const Document& document, const std::string& edge, const SurfacePoint& apex,
                        std::optional<double> at, const NewCurve& curve) {
  const Result<std::vector<Place>> place = placesOf(document, std::span(&apex, 1));
  if (!place) return place.error();
  Sketch sketch(document);
  const Result<WorkCurve> work = sketch.load(edge);
  if (!work) return work.error();
  if (!at) {
    const SurfacePath path = detail::pathOf(*work);
    at = nearestOnPath(sketch.mesh(), path, position(sketch.mesh(), apex)).arc /
         length(sketch.mesh(), path);
  }
  const Result<double> checked = detail::checkedFraction(*at);
  if (!checked) return checked.error();
  NewCurve dart = curve;
  dart.kind = CurveKind::Dart;
  if (dart.id.empty()) dart.id = sketch.freeId("dart");
  ShortestWay way{{OnStylingCurve{edge, *checked}, place->front()}};
  return addByWay(document, begun(dart, std::move(way), false), true);
}

Result<Edited> drawAlongModelCurve(const Document& document, const std::string& name,
                                   const Stretch& stretch, const NewCurve& curve) {
  const auto found = document.model->curves.find(name);
  const bool isWhole = stretch.from == 0 && stretch.to == 1;
  const bool closed = found != document.model->curves.end() && found->second.closed && isWhole;
  return addByWay(document, begun(curve, AlongModelCurve{name, stretch.from, stretch.to}, closed));
}

Result<Edited> drawAlongEdges(const Document& document, std::span<const VertexId> vertices,
                              const NewCurve& curve) {
  const Mesh& mesh = *document.model->mesh;
  AlongVertices way;
  for (const VertexId v : vertices) {
    if (v.index() >= mesh.vertexCount()) {
      return Error{
          ErrorCode::CurveInvalid, fmt::format("the model has no vertex {}", v.index()), {}};
    }
    if (way.vertices.empty()) {
      way.vertices.push_back(v);
    } else if (!(way.vertices.back() == v)) {
      const Result<std::vector<VertexId>> row = edgesTo(mesh, way.vertices.back(), v);
      if (!row) return row.error();
      way.vertices.insert(way.vertices.end(), row->begin(), row->end());
    }
  }
  return addByWay(document, begun(curve, std::move(way), false));
}

}  // namespace toile
