// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/drawn_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace toile::test {
namespace {

using Random = std::mt19937_64;

// The library's distributions differ between implementations; the numbers here do not.
double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}
std::size_t below(Random& random, std::size_t count) {
  return random() % count;
}
bool chance(Random& random, double probability) {
  return uniform(random, 0, 1) < probability;
}

SurfacePoint randomPointIn(const Mesh& mesh, FaceId face, Random& random) {
  Eigen::Vector3d weights(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
  if (chance(random, 0.1)) weights[static_cast<Eigen::Index>(below(random, 3))] *= 1e-5;
  return makeSurfacePoint(mesh, face, weights / weights.sum());
}

SurfacePoint randomPointOn(const Mesh& mesh, HalfedgeId h, Random& random) {
  if (chance(random, 0.2)) return {mesh.from(h)};
  double t = uniform(random, 0.02, 0.98);
  if (chance(random, 0.15)) t = std::pow(10.0, uniform(random, -9, -2));
  return {SurfacePoint::OnEdge{mesh.edge(h), chance(random, 0.5) ? t : 1 - t}};
}

/// From face to face: to a point of a side, sometimes by way of one inside.
std::vector<SurfacePoint> randomWalk(const Mesh& mesh, SurfacePoint from, int steps,
                                     Random& random) {
  std::vector<SurfacePoint> points{from};
  for (int i = 0; i < steps; ++i) {
    const std::vector<FaceId> faces = facesOf(mesh, points.back());
    const FaceId face = faces[below(random, faces.size())];
    if (chance(random, 0.2)) points.push_back(randomPointIn(mesh, face, random));
    const HalfedgeId h = mesh.halfedge(face, static_cast<int>(below(random, 3)));
    points.push_back(randomPointOn(mesh, h, random));
  }
  return points;
}

/// The same line a little beside: points move on their edge or in their face.
SurfacePoint moved(const Mesh& mesh, const SurfacePoint& point, double distance, Random& random) {
  const double amount = uniform(random, -distance, distance);
  if (const auto* e = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    const double t = std::clamp(e->t + amount / mesh.length(e->edge), 1e-12, 1 - 1e-12);
    return {SurfacePoint::OnEdge{e->edge, t}};
  }
  if (const auto* in = std::get_if<SurfacePoint::InFace>(&point.at)) {
    Eigen::Vector3d weights = in->barycentric;
    weights[0] += amount / mesh.length(mesh.edge(mesh.halfedge(in->face, 0)));
    return makeSurfacePoint(mesh, in->face, weights.cwiseMax(0.0) / weights.cwiseMax(0.0).sum());
  }
  return point;
}

std::vector<SurfacePoint> withoutRepeats(std::vector<SurfacePoint> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

CurveKind randomKind(Random& random) {
  constexpr std::array kKinds{CurveKind::Seam,    CurveKind::Seam,    CurveKind::Opening,
                              CurveKind::Feature, CurveKind::Elastic, CurveKind::Dart};
  return kKinds[below(random, kKinds.size())];
}

}  // namespace

SurfacePath pathThrough(const Mesh& mesh, std::vector<SurfacePoint> points, bool closed) {
  SurfacePath path;
  path.points = std::move(points);
  path.closed = closed;
  const std::size_t count = path.points.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
    path.faceOfSegment.push_back(commonFace(mesh, path.points[i], path.points[(i + 1) % count]));
  }
  return path;
}

SurfacePath edgePath(const Mesh& mesh, const std::vector<VertexId>& vertices, bool closed) {
  return pathThrough(mesh, {vertices.begin(), vertices.end()}, closed);
}

std::vector<SurfacePath> planeSections(const Mesh& mesh, const Eigen::Vector3d& normal,
                                       double offset) {
  const auto height = [&](VertexId v) { return normal.dot(mesh.position(v)) - offset; };
  const auto enters = [&](HalfedgeId h) {  // upwards: the way on keeps what is above on its left
    return height(mesh.from(h)) < 0 && height(mesh.to(h)) > 0;
  };
  const auto pointOn = [&](HalfedgeId h) -> SurfacePoint {
    const EdgeId e = mesh.edge(h);
    const double tail = height(mesh.tail(e));
    return {SurfacePoint::OnEdge{e, tail / (tail - height(mesh.head(e)))}};
  };
  std::vector<bool> done(mesh.halfedgeCount(), false);
  const auto trace = [&](HalfedgeId start) {
    SurfacePath path;
    HalfedgeId h = start;
    while (h.isValid() && !done[h.index()]) {
      done[h.index()] = true;
      path.points.push_back(pointOn(h));
      path.faceOfSegment.push_back(mesh.face(h));
      HalfedgeId out = mesh.next(h);
      if (!(height(mesh.from(out)) > 0 && height(mesh.to(out)) < 0)) out = mesh.next(out);
      h = mesh.opposite(out);
      if (!h.isValid()) path.points.push_back(pointOn(out));
    }
    path.closed = h.isValid();
    return path;
  };
  std::vector<SurfacePath> paths;
  for (const bool fromBorder : {true, false}) {
    for (std::size_t i = 0; i < mesh.halfedgeCount(); ++i) {
      const HalfedgeId h(i);
      if (done[i] || !enters(h) || (fromBorder && mesh.opposite(h).isValid())) continue;
      paths.push_back(trace(h));
    }
  }
  return paths;
}

PlacedCurve drawn(std::string id, CurveKind kind, SurfacePath path) {
  PlacedCurve curve;
  curve.id = std::move(id);
  curve.kind = kind;
  curve.dataPoints = path.points;
  curve.path = std::move(path);
  return curve;
}

std::vector<PlacedCurve> randomCurves(const Mesh& mesh, int count, Random& random) {
  std::vector<PlacedCurve> curves;
  for (int c = 0; c < count; ++c) {
    const int steps = 2 + static_cast<int>(below(random, 12));
    std::vector<SurfacePoint> points;
    bool closed = false;
    const double choice = uniform(random, 0, 1);
    const PlacedCurve* earlier = curves.empty() ? nullptr : &curves[below(random, curves.size())];
    if (choice < 0.25 && earlier != nullptr) {  // beside, or on, an earlier one
      points = earlier->path.points;
      closed = earlier->path.closed;
      const double distance = chance(random, 0.2) ? 0.0 : std::pow(10.0, uniform(random, -9, -1.5));
      for (SurfacePoint& p : points) p = moved(mesh, p, distance, random);
      if (chance(random, 0.3)) std::reverse(points.begin(), points.end());
    } else if (choice < 0.4 && earlier != nullptr) {  // shares a part, then goes its own way
      const auto& all = earlier->path.points;
      const std::size_t from = below(random, all.size());
      const std::size_t to = from + below(random, all.size() - from);
      points.assign(all.begin() + static_cast<std::ptrdiff_t>(from),
                    all.begin() + static_cast<std::ptrdiff_t>(to) + 1);
      const std::vector<SurfacePoint> walk = randomWalk(mesh, points.back(), steps, random);
      points.insert(points.end(), walk.begin() + 1, walk.end());
    } else if (choice < 0.55) {  // along edges
      VertexId at(below(random, mesh.vertexCount()));
      for (int i = 0; i < steps; ++i) {
        points.push_back({at});
        const std::vector<FaceId> faces = mesh.facesAround(at);
        at = mesh.vertices(faces[below(random, faces.size())])[below(random, 3)];
      }
    } else if (choice < 0.75) {  // a plane section
      const Eigen::Vector3d normal(uniform(random, -1, 1), uniform(random, -1, 1),
                                   uniform(random, -1, 1));
      const Eigen::Vector3d through(uniform(random, mesh.boxMin().x(), mesh.boxMax().x()),
                                    uniform(random, mesh.boxMin().y(), mesh.boxMax().y()),
                                    uniform(random, mesh.boxMin().z(), mesh.boxMax().z()));
      const std::vector<SurfacePath> paths = planeSections(mesh, normal, normal.dot(through));
      if (!paths.empty()) {
        points = paths.front().points;
        closed = paths.front().closed;
      }
    } else {
      const FaceId face(below(random, mesh.faceCount()));
      points = randomWalk(mesh, randomPointIn(mesh, face, random), steps, random);
    }
    points = withoutRepeats(std::move(points));
    if (closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
    if (points.size() < (closed ? 3U : 2U)) continue;
    SurfacePath path = pathThrough(mesh, std::move(points), closed);
    if (!isValid(mesh, path)) continue;  // moved points may have lost their common face
    curves.push_back(drawn("c" + std::to_string(c), randomKind(random), std::move(path)));
  }
  return curves;
}

}  // namespace toile::test
