// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/surface_point.h"

#include <algorithm>
#include <cmath>

namespace toile {

namespace {

// Calls a form of the variant by its type.
template <class... Ts>
struct Overload : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overload(Ts...) -> Overload<Ts...>;

int cornerOf(const Mesh& mesh, FaceId face, VertexId v) {
  const Triangle& corners = mesh.vertices(face);
  for (int k = 0; k < 3; ++k) {
    if (corners[static_cast<std::size_t>(k)] == v) return k;
  }
  return 3;
}

bool isSide(const Mesh& mesh, FaceId face, EdgeId edge) {
  const HalfedgeId h = mesh.halfedge(edge);
  const HalfedgeId o = mesh.opposite(h);
  return mesh.face(h) == face || (o.isValid() && mesh.face(o) == face);
}

std::size_t segmentCount(const SurfacePath& path) {
  return path.closed ? path.points.size() : path.points.size() - 1;
}

/// Arc length at each point, and at the end of the last segment.
std::vector<double> arcLengths(const Mesh& mesh, const SurfacePath& path) {
  const std::size_t count = segmentCount(path);
  std::vector<double> arc{0};
  arc.reserve(count + 1);
  Eigen::Vector3d a = position(mesh, path.points.front());
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d b = position(mesh, path.points[(i + 1) % path.points.size()]);
    arc.push_back(arc.back() + (b - a).norm());
    a = b;
  }
  return arc;
}

/// A place on a path: the segment and how far along it (0 = its first point).
struct PathPlace {
  std::size_t segment = 0;
  double along = 0;
};

PathPlace placeAt(const std::vector<double>& arc, double fraction) {
  const double s = std::clamp(fraction, 0.0, 1.0) * arc.back();
  const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, s);
  const auto segment = static_cast<std::size_t>(above - arc.begin()) - 1;
  const double span = arc[segment + 1] - arc[segment];
  return {segment, span > 0 ? std::clamp((s - arc[segment]) / span, 0.0, 1.0) : 0.0};
}

SurfacePoint pointAt(const Mesh& mesh, const SurfacePath& path, const PathPlace& place) {
  const SurfacePoint& a = path.points[place.segment];
  const SurfacePoint& b = path.points[(place.segment + 1) % path.points.size()];
  if (place.along <= 0) return a;
  if (place.along >= 1) return b;
  const FaceId face = path.faceOfSegment[place.segment];
  const Eigen::Vector3d weights =
      (1 - place.along) * barycentricIn(mesh, a, face) + place.along * barycentricIn(mesh, b, face);
  return makeSurfacePoint(mesh, face, weights);
}

}  // namespace

SurfacePoint makeSurfacePoint(const Mesh& mesh, FaceId face, const Eigen::Vector3d& barycentric) {
  Eigen::Vector3d weights = barycentric.cwiseMax(0.0);
  weights /= weights.sum();
  const Triangle& corners = mesh.vertices(face);
  const auto zeros = (weights.array() <= 0.0).count();
  if (zeros == 0) return {SurfacePoint::InFace{face, weights}};
  if (zeros == 2) {
    Eigen::Index largest = 0;
    weights.maxCoeff(&largest);
    return {corners[static_cast<std::size_t>(largest)]};
  }
  Eigen::Index zero = 0;
  weights.minCoeff(&zero);
  const int side = static_cast<int>((zero + 1) % 3);
  const EdgeId edge = mesh.edge(mesh.halfedge(face, side));
  const bool fromTail = mesh.tail(edge) == corners[static_cast<std::size_t>(side)];
  const double t = fromTail ? weights[(side + 1) % 3] : weights[side];
  if (t <= 0.0) return {mesh.tail(edge)};
  if (t >= 1.0) return {mesh.head(edge)};
  return {SurfacePoint::OnEdge{edge, t}};
}

Eigen::Vector3d position(const Mesh& mesh, const SurfacePoint& point) {
  return std::visit(Overload{[&](VertexId v) -> Eigen::Vector3d { return mesh.position(v); },
                             [&](const SurfacePoint::OnEdge& on) -> Eigen::Vector3d {
                               return (1 - on.t) * mesh.position(mesh.tail(on.edge)) +
                                      on.t * mesh.position(mesh.head(on.edge));
                             },
                             [&](const SurfacePoint::InFace& in) -> Eigen::Vector3d {
                               const auto& [a, b, c] = mesh.vertices(in.face);
                               return in.barycentric[0] * mesh.position(a) +
                                      in.barycentric[1] * mesh.position(b) +
                                      in.barycentric[2] * mesh.position(c);
                             }},
                    point.at);
}

std::vector<FaceId> facesOf(const Mesh& mesh, const SurfacePoint& point) {
  std::vector<FaceId> faces = std::visit(
      Overload{[&](VertexId v) { return mesh.facesAround(v); },
               [&](const SurfacePoint::OnEdge& on) {
                 const HalfedgeId h = mesh.halfedge(on.edge);
                 const HalfedgeId o = mesh.opposite(h);
                 std::vector<FaceId> both{mesh.face(h)};
                 if (o.isValid()) both.push_back(mesh.face(o));
                 return both;
               },
               [&](const SurfacePoint::InFace& in) { return std::vector<FaceId>{in.face}; }},
      point.at);
  std::sort(faces.begin(), faces.end());
  return faces;
}

bool touches(const Mesh& mesh, const SurfacePoint& point, FaceId face) {
  return std::visit(
      Overload{[&](VertexId v) { return cornerOf(mesh, face, v) < 3; },
               [&](const SurfacePoint::OnEdge& on) { return isSide(mesh, face, on.edge); },
               [&](const SurfacePoint::InFace& in) { return in.face == face; }},
      point.at);
}

Eigen::Vector3d barycentricIn(const Mesh& mesh, const SurfacePoint& point, FaceId face) {
  TOILE_ASSERT(touches(mesh, point, face));
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  std::visit(Overload{[&](VertexId v) { weights[cornerOf(mesh, face, v)] = 1; },
                      [&](const SurfacePoint::OnEdge& on) {
                        weights[cornerOf(mesh, face, mesh.tail(on.edge))] = 1 - on.t;
                        weights[cornerOf(mesh, face, mesh.head(on.edge))] = on.t;
                      },
                      [&](const SurfacePoint::InFace& in) { weights = in.barycentric; }},
             point.at);
  return weights;
}

FaceId commonFace(const Mesh& mesh, const SurfacePoint& a, const SurfacePoint& b) {
  for (const FaceId face : facesOf(mesh, a)) {
    if (touches(mesh, b, face)) return face;
  }
  return {};
}

bool isValid(const Mesh& mesh, const SurfacePoint& point) {
  return std::visit(Overload{[&](VertexId v) { return v.index() < mesh.vertexCount(); },
                             [&](const SurfacePoint::OnEdge& on) {
                               return on.edge.index() < mesh.edgeCount() && on.t > 0 && on.t < 1;
                             },
                             [&](const SurfacePoint::InFace& in) {
                               return in.face.index() < mesh.faceCount() &&
                                      in.barycentric.allFinite() && in.barycentric.minCoeff() > 0 &&
                                      std::abs(in.barycentric.sum() - 1) <= 1e-9;
                             }},
                    point.at);
}

double length(const Mesh& mesh, const SurfacePath& path) {
  double sum = 0;
  Eigen::Vector3d a = position(mesh, path.points.front());
  for (std::size_t i = 0; i < segmentCount(path); ++i) {
    const Eigen::Vector3d b = position(mesh, path.points[(i + 1) % path.points.size()]);
    sum += (b - a).norm();
    a = b;
  }
  return sum;
}

SurfacePoint pointAtFraction(const Mesh& mesh, const SurfacePath& path, double fraction) {
  if (path.closed) fraction -= std::floor(fraction);
  return pointAt(mesh, path, placeAt(arcLengths(mesh, path), fraction));
}

SurfacePath subPath(const Mesh& mesh, const SurfacePath& path, double a, double b) {
  const bool isReversed = !path.closed && b < a;
  if (isReversed) std::swap(a, b);
  const bool isWrapping = path.closed && b < a;
  const std::vector<double> arc = arcLengths(mesh, path);
  const PathPlace first = placeAt(arc, a);
  const PathPlace last = placeAt(arc, b);

  SurfacePath part;
  const auto append = [&](const SurfacePoint& point, FaceId faceFromPrevious) {
    if (!part.points.empty() && part.points.back() == point) return;
    if (!part.points.empty()) part.faceOfSegment.push_back(faceFromPrevious);
    part.points.push_back(point);
  };
  append(pointAt(mesh, path, first), FaceId());
  const std::size_t count = segmentCount(path);
  const std::size_t steps = last.segment + (isWrapping ? count : 0) - first.segment;
  for (std::size_t i = 0; i < steps; ++i) {
    const std::size_t segment = (first.segment + i) % count;
    append(path.points[(segment + 1) % path.points.size()], path.faceOfSegment[segment]);
  }
  append(pointAt(mesh, path, last), path.faceOfSegment[last.segment]);
  if (isReversed) {
    std::reverse(part.points.begin(), part.points.end());
    std::reverse(part.faceOfSegment.begin(), part.faceOfSegment.end());
  }
  return part;
}

bool isValid(const Mesh& mesh, const SurfacePath& path) {
  if (path.points.size() < (path.closed ? 3U : 2U)) return false;
  if (path.faceOfSegment.size() != segmentCount(path)) return false;
  for (const SurfacePoint& point : path.points) {
    if (!isValid(mesh, point)) return false;
  }
  for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
    const FaceId face = path.faceOfSegment[i];
    if (face.index() >= mesh.faceCount() || !touches(mesh, path.points[i], face) ||
        !touches(mesh, path.points[(i + 1) % path.points.size()], face)) {
      return false;
    }
  }
  return true;
}

}  // namespace toile
