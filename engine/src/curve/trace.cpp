// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/trace.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toile {

namespace {

using Eigen::Vector3d;

/// Weights below this count as zero: the walk then goes through the edge or vertex itself.
constexpr double kOnSide = 1e-12;
constexpr int kMaxFaces = 200000;

/// A step is to be made from a point into a face, in a direction within the face's plane.
struct Heading {
  FaceId face;
  Vector3d direction;  ///< unit
};

std::size_t cornerOf(const Mesh& mesh, FaceId face, VertexId v) {
  const Triangle& corners = mesh.vertices(face);
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
}

/// How fast the weights of a point change that moves in the face.
Vector3d weightRates(const Mesh& mesh, FaceId face, const Vector3d& direction) {
  const Triangle& t = mesh.vertices(face);
  const Vector3d normal =
      (mesh.position(t[1]) - mesh.position(t[0])).cross(mesh.position(t[2]) - mesh.position(t[0]));
  const double square = normal.squaredNorm();
  Vector3d rates = Vector3d::Zero();
  if (!(square > 0)) return rates;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d side = mesh.position(t[(k + 2) % 3]) - mesh.position(t[(k + 1) % 3]);
    rates[static_cast<Eigen::Index>(k)] = direction.dot(normal.cross(side)) / square;
  }
  return rates;
}

/// The face of the point's star that the direction leads into: the one whose inside it meets best.
std::optional<Heading> headingFrom(const Mesh& mesh, const SurfacePoint& from,
                                   const Vector3d& direction) {
  std::optional<Heading> best;
  double bestScore = -std::numeric_limits<double>::infinity();
  for (const FaceId face : facesOf(mesh, from)) {
    const Vector3d normal = mesh.normal(face);
    const Vector3d flat = direction - normal.dot(direction) * normal;
    if (!(flat.norm() > 1e-9 * direction.norm())) continue;
    const Vector3d unit = flat.normalized();
    const Vector3d rates = weightRates(mesh, face, unit);
    const Vector3d weights = barycentricIn(mesh, from, face);
    double inward = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (weights[k] > 0) continue;
      // Distance gained from side k per step: the rate times the height over that side.
      const Triangle& t = mesh.vertices(face);
      const double side = mesh.length(mesh.findEdge(t[static_cast<std::size_t>((k + 1) % 3)],
                                                    t[static_cast<std::size_t>((k + 2) % 3)]));
      inward = std::min(inward, rates[k] * 2 * mesh.area(face) / side);
    }
    const double score = std::min(inward, 1.0);
    if (score > bestScore) {
      bestScore = score;
      best = Heading{face, unit};
    }
  }
  // A little outside of every face's wedge is the gap that a bent star leaves; far outside is the
  // border.
  if (!best || bestScore < -0.5) return std::nullopt;
  return best;
}

/// Over the edge of a halfedge into the neighbour, unfolded.
std::optional<Heading> acrossEdge(const Mesh& mesh, HalfedgeId h, const Vector3d& direction) {
  const HalfedgeId o = mesh.opposite(h);
  if (!o.isValid()) return std::nullopt;
  const Vector3d along = (mesh.position(mesh.to(h)) - mesh.position(mesh.from(h))).normalized();
  // Left of h is the face that is left; the neighbour lies on its right.
  const Vector3d outHere = along.cross(mesh.normal(mesh.face(h)));
  const Vector3d outThere = along.cross(mesh.normal(mesh.face(o)));
  const double a = direction.dot(along), b = direction.dot(outHere);
  const Vector3d turned = a * along + b * outThere;
  if (!(turned.norm() > 0)) return std::nullopt;
  return Heading{mesh.face(o), turned.normalized()};
}

/// Through a vertex: as much angle on the left as on the right.
std::optional<Heading> throughVertex(const Mesh& mesh, VertexId v, FaceId arrivedIn,
                                     const Vector3d& direction) {
  if (mesh.isBorder(v)) return std::nullopt;
  const auto directionTo = [&](VertexId to) -> Vector3d {
    return (mesh.position(to) - mesh.position(v)).normalized();
  };
  const auto angle = [](const Vector3d& a, const Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  };
  // Halfedges leaving v counter-clockwise, from the one that bounds the arrival face on its right.
  HalfedgeId h = mesh.halfedge(arrivedIn, static_cast<int>(cornerOf(mesh, arrivedIn, v)));
  const HalfedgeId first = h;
  double total = 0;
  do {
    total += angle(directionTo(mesh.to(h)), directionTo(mesh.from(mesh.previous(h))));
    h = mesh.opposite(mesh.previous(h));
  } while (h != first);
  double left = angle(directionTo(mesh.to(first)), -direction) + total / 2;
  for (int turns = 0; turns < 1000; ++turns) {
    const Vector3d start = directionTo(mesh.to(h));
    const double corner = angle(start, directionTo(mesh.from(mesh.previous(h))));
    if (left <= corner) {
      const FaceId face = mesh.face(h);
      const Vector3d aside = mesh.normal(face).cross(start);
      return Heading{face, (std::cos(left) * start + std::sin(left) * aside).normalized()};
    }
    left -= corner;
    h = mesh.opposite(mesh.previous(h));
  }
  return std::nullopt;
}

}  // namespace

std::optional<SurfacePath> traceStraight(const Mesh& mesh, const SurfacePoint& from,
                                         const Vector3d& direction, double length) {
  if (!(length > 0) || !direction.allFinite()) return std::nullopt;
  std::optional<Heading> heading = headingFrom(mesh, from, direction);
  SurfacePath path;
  path.points.push_back(from);
  double rest = length;
  for (int i = 0; heading && i < kMaxFaces; ++i) {
    const FaceId face = heading->face;
    const Vector3d weights = barycentricIn(mesh, path.points.back(), face);
    const Vector3d rates = weightRates(mesh, face, heading->direction);
    double reach = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (rates[k] < 0) reach = std::min(reach, weights[k] / -rates[k]);
    }
    if (!std::isfinite(reach)) break;
    const bool ends = rest <= reach;
    Vector3d next = weights + std::min(rest, reach) * rates;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (next[k] < kOnSide) next[k] = 0;
    }
    const SurfacePoint point = makeSurfacePoint(mesh, face, next);
    if (!(point == path.points.back())) {
      path.points.push_back(point);
      path.faceOfSegment.push_back(face);
    }
    rest -= reach;
    if (ends) break;
    if (const auto* v = std::get_if<VertexId>(&point.at)) {
      heading = throughVertex(mesh, *v, face, heading->direction);
    } else if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
      HalfedgeId h = mesh.halfedge(on->edge);
      if (mesh.face(h) != face) h = mesh.opposite(h);
      heading = acrossEdge(mesh, h, heading->direction);
    } else {
      break;
    }
  }
  if (path.points.size() < 2) return std::nullopt;
  return path;
}

}  // namespace toile
