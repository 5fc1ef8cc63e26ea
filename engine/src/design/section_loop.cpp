// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/section_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace toile::detail {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Coordinates within a plane, seen from the tip of its normal.
struct PlaneFrame {
  explicit PlaneFrame(const Vector3d& normal)
      : x(normal.unitOrthogonal()), y(normal.normalized().cross(x)) {}
  [[nodiscard]] Vector2d operator()(const Vector3d& p) const { return {x.dot(p), y.dot(p)}; }
  Vector3d x, y;
};

double cross(const Vector2d& u, const Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

std::vector<Vector2d> flatten(const Mesh& mesh, const SurfacePath& loop, const PlaneFrame& frame) {
  std::vector<Vector2d> flat;
  for (const SurfacePoint& point : loop.points) flat.push_back(frame(position(mesh, point)));
  return flat;
}

std::size_t segmentCount(const SurfacePath& path) {
  return path.faceOfSegment.size();
}

/// Twice the signed area of the loop around its first point.
double doubleArea(const std::vector<Vector2d>& flat) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
    sum += cross(flat[i] - flat[0], flat[i + 1] - flat[0]);
  }
  return sum;
}

/// Of the area inside a closed loop; of the line itself for an open one.
Vector2d centroid(const SurfacePath& loop, const std::vector<Vector2d>& flat) {
  Vector2d sum = Vector2d::Zero();
  double weight = 0;
  const std::size_t count = flat.size();
  const bool hasArea = loop.closed && std::abs(doubleArea(flat)) > 0;
  for (std::size_t i = 0; i < segmentCount(loop); ++i) {
    const Vector2d &a = flat[i], &b = flat[(i + 1) % count];
    const double w = hasArea ? cross(a - flat[0], b - flat[0]) : (b - a).norm();
    sum += w * (hasArea ? Vector2d((a + b + flat[0]) / 3) : Vector2d(0.5 * (a + b)));
    weight += w;
  }
  return weight != 0 ? Vector2d(sum / weight) : flat[0];
}

struct Crossing {
  std::size_t segment = 0;
  double along = 0;
};

/// The last crossing of the loop with the ray from its centroid.
std::optional<Crossing> lastCrossing(const SurfacePath& loop, const std::vector<Vector2d>& flat,
                                     const Vector2d& direction) {
  const Vector2d origin = centroid(loop, flat);
  std::optional<Crossing> last;
  double farthest = -1;
  for (std::size_t i = 0; i < segmentCount(loop); ++i) {
    const Vector2d a = flat[i] - origin, b = flat[(i + 1) % flat.size()] - origin;
    const double sideA = cross(direction, a), sideB = cross(direction, b);
    if ((sideA > 0) == (sideB > 0)) continue;
    const double along = sideA / (sideA - sideB);
    const double distance = direction.dot(a + along * (b - a));
    if (distance >= 0 && distance > farthest) {
      farthest = distance;
      last = Crossing{i, along};
    }
  }
  return last;
}

SurfacePoint pointAt(const Mesh& mesh, const SurfacePath& loop, const Crossing& crossing) {
  const SurfacePoint& a = loop.points[crossing.segment];
  const SurfacePoint& b = loop.points[(crossing.segment + 1) % loop.points.size()];
  if (crossing.along <= 0) return a;
  if (crossing.along >= 1) return b;
  const FaceId face = loop.faceOfSegment[crossing.segment];
  return makeSurfacePoint(mesh, face,
                          (1 - crossing.along) * barycentricIn(mesh, a, face) +
                              crossing.along * barycentricIn(mesh, b, face));
}

/// The closed loop, starting at a point of one of its segments.
SurfacePath startingAt(const SurfacePath& loop, const Crossing& crossing,
                       const SurfacePoint& start) {
  SurfacePath turned;
  turned.closed = true;
  const std::size_t count = loop.points.size();
  turned.points.push_back(start);
  for (std::size_t i = 0; i <= count; ++i) {
    const std::size_t segment = (crossing.segment + i) % count;
    const SurfacePoint& next = loop.points[(segment + 1) % count];
    if (i == count) {  // the rest of the segment in which the loop starts
      if (!(turned.points.back() == start))
        turned.faceOfSegment.push_back(loop.faceOfSegment[segment]);
      break;
    }
    if (next == turned.points.back()) continue;
    turned.faceOfSegment.push_back(loop.faceOfSegment[segment]);
    if (next == start) break;
    turned.points.push_back(next);
  }
  return turned;
}

double distanceTo(const Mesh& mesh, const SurfacePath& path, const Vector3d& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < segmentCount(path); ++i) {
    const Vector3d a = position(mesh, path.points[i]);
    const Vector3d d = position(mesh, path.points[(i + 1) % path.points.size()]) - a;
    const double square = d.squaredNorm();
    const double t = square > 0 ? std::clamp((place - a).dot(d) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (a + t * d - place).norm());
  }
  return nearest;
}

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

Error nameNotFound(std::string_view what, const std::string& name,
                   const std::vector<std::string>& known) {
  std::string message = fmt::format("there is no {} \"{}\"", what, name);
  const auto nearest = std::min_element(
      known.begin(), known.end(),
      [&](const auto& a, const auto& b) { return editDistance(a, name) < editDistance(b, name); });
  if (nearest == known.end()) {
    message += fmt::format("; there is none at all");
  } else {
    message += fmt::format("; did you mean \"{}\"?", *nearest);
  }
  return {ErrorCode::NameNotFound, message, {}};
}

Result<SurfacePoint> pointOnLoop(const Mesh& mesh, const SurfacePath& loop, const Vector3d& normal,
                                 const Vector3d& direction) {
  const PlaneFrame frame(normal);
  const Vector2d inPlane = frame(direction);
  if (!(inPlane.norm() > 1e-9 * direction.norm())) {
    return Error{ErrorCode::InvalidArgument,
                 "the direction of a point on a section must not be along the plane's normal",
                 {}};
  }
  const std::vector<Vector2d> flat = flatten(mesh, loop, frame);
  const std::optional<Crossing> crossing = lastCrossing(loop, flat, inPlane.normalized());
  if (!crossing) {
    return Error{ErrorCode::CurveInvalid,
                 "the section has no point in that direction; try another direction",
                 {}};
  }
  return pointAt(mesh, loop, *crossing);
}

Result<SurfacePath> sectionLoop(const SectionPlane& plane, const ReferenceModel& model) {
  const Mesh& mesh = *model.mesh;
  if (!(plane.normal.norm() > 0) || !plane.normal.allFinite()) {
    return Error{ErrorCode::InvalidArgument, "a section plane needs a normal that is not zero", {}};
  }
  const Vector3d normal = plane.normal.normalized();
  std::optional<Vector3d> through;
  double offset = 0;
  if (const auto* landmark = std::get_if<AtLandmark>(&plane.through)) {
    const auto found = model.landmarks.find(landmark->name);
    if (found == model.landmarks.end()) {
      std::vector<std::string> known;
      for (const auto& entry : model.landmarks) known.push_back(entry.first);
      return nameNotFound("landmark", landmark->name, known);
    }
    through = position(mesh, found->second);
    offset = normal.dot(*through);
  } else if (const auto* stored = std::get_if<ModelPoint>(&plane.through)) {
    const Result<SurfacePoint> point = toSurfacePoint(mesh, *stored);
    if (!point) return point.error();
    through = position(mesh, *point);
    offset = normal.dot(*through);
  } else {
    offset = std::get<Length>(plane.through).mm();
  }

  const std::vector<SurfacePath> loops = model.index->planeSection(normal, offset);
  if (loops.empty()) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Vector3d& p : mesh.positions()) {
      lowest = std::min(lowest, normal.dot(p));
      highest = std::max(highest, normal.dot(p));
    }
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("the plane at {:.1f} mm does not cut the model, which reaches from "
                             "{:.1f} to {:.1f} mm along its normal",
                             offset, lowest, highest),
                 {}};
  }
  SurfacePath loop = loops.front();
  if (through) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const SurfacePath& candidate : loops) {
      const double distance = distanceTo(mesh, candidate, *through);
      if (distance < nearest) {
        nearest = distance;
        loop = candidate;
      }
    }
  }
  if (!loop.closed) return loop;

  const PlaneFrame frame(normal);
  std::vector<Vector2d> flat = flatten(mesh, loop, frame);
  if (doubleArea(flat) < 0) {
    // Keeps the first point; segment i then runs from point i to i + 1 again.
    std::reverse(loop.points.begin() + 1, loop.points.end());
    std::reverse(loop.faceOfSegment.begin(), loop.faceOfSegment.end());
    std::reverse(flat.begin() + 1, flat.end());
  }
  const bool isAlongY = std::abs(normal.y()) > 0.9;
  const Vector2d front = frame(isAlongY ? Vector3d(0, 0, 1) : Vector3d(0, -1, 0)).normalized();
  const std::optional<Crossing> crossing = lastCrossing(loop, flat, front);
  if (!crossing) return loop;
  return startingAt(loop, *crossing, pointAt(mesh, loop, *crossing));
}

}  // namespace toile::detail
