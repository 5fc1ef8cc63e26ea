// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/edit/measure.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "design/section_loop.h"
#include "edit/sketch.h"
#include "toile/curve/crossing.h"

namespace toile {

using detail::Sketch;
using Eigen::Vector3d;

namespace {

Result<SurfacePath> pathOf(Sketch& sketch, const std::string& id) {
  Result<detail::WorkCurve> work = sketch.load(id);
  if (!work) return work.error();
  return detail::pathOf(*work);
}

/// Direction of a path around an arc length, over a part of a millimetre.
Vector3d directionAt(const Mesh& mesh, const SurfacePath& path, double arc) {
  const double all = length(mesh, path), reach = std::min(0.5, 0.01 * all);
  const auto at = [&](double s) {
    return position(
        mesh, pointAtFraction(mesh, path, path.closed ? s / all : std::clamp(s / all, 0.0, 1.0)));
  };
  return at(arc + reach) - at(arc - reach);
}

}  // namespace

Result<Length> curveLength(const Document& document, const std::string& curve) {
  return stretchLength(document, curve, {0, 1});
}

Result<Length> stretchLength(const Document& document, const std::string& curve,
                             const Stretch& stretch) {
  for (const double f : {stretch.from, stretch.to}) {
    if (const Result<double> checked = detail::checkedFraction(f); !checked) return checked.error();
  }
  Sketch sketch(document);
  const Result<SurfacePath> path = pathOf(sketch, curve);
  if (!path) return path.error();
  double part = stretch.to - stretch.from;
  if (part < 0) part = path->closed ? part + 1 : -part;
  return Length::mm(part * length(sketch.mesh(), *path));
}

Result<Length> surfaceDistance(const ReferenceModel& model, const SurfacePoint& a,
                               const SurfacePoint& b) {
  if (isValid(*model.mesh, a) && a == b) return Length();
  GeodesicLinker linker(model.mesh);
  const Result<SurfacePath> way = linker.link(a, b);
  if (!way) return way.error();
  return Length::mm(length(*model.mesh, *way));
}

Result<Length> girthThrough(const ReferenceModel& model, const SurfacePoint& point,
                            const Vector3d& normal) {
  if (!isValid(*model.mesh, point)) {
    return Error{ErrorCode::CurveInvalid, "the point does not lie on the model", {}};
  }
  SectionPlane plane;
  plane.normal = normal;
  plane.through = toModelPoint(*model.mesh, point);
  const Result<SurfacePath> loop = detail::sectionLoop(plane, model);
  if (!loop) return loop.error();
  return Length::mm(length(*model.mesh, *loop));
}

Result<std::vector<CurveMeeting>> meetingsOf(const Document& document, const std::string& first,
                                             const std::string& second) {
  Sketch sketch(document);
  const Result<SurfacePath> a = pathOf(sketch, first), b = pathOf(sketch, second);
  if (!a) return a.error();
  if (!b) return b.error();
  const Mesh& mesh = sketch.mesh();
  const double lengthA = length(mesh, *a), lengthB = length(mesh, *b);
  std::vector<CurveMeeting> meetings;
  for (const PathMeeting& meeting : findMeetings(mesh, *a, *b)) {
    const Vector3d normal = smoothNormal(mesh, meeting.point);
    const auto flat = [&](const Vector3d& v) -> Vector3d { return v - normal.dot(v) * normal; };
    const Vector3d u = flat(directionAt(mesh, *a, meeting.a));
    const Vector3d v = flat(directionAt(mesh, *b, meeting.b));
    meetings.push_back({meeting.a / lengthA, meeting.b / lengthB, meeting.point,
                        Angle::radians(std::atan2(u.cross(v).norm(), u.dot(v)))});
  }
  return meetings;
}

Result<std::vector<CurvatureSample>> curvatureOf(const Document& document, const std::string& curve,
                                                 std::size_t samples) {
  constexpr std::size_t kMost = 100000;
  if (samples < 3 || samples > kMost) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("the number of samples must be 3 to {}, not {}", kMost, samples),
                 {}};
  }
  Sketch sketch(document);
  const Result<SurfacePath> path = pathOf(sketch, curve);
  if (!path) return path.error();
  return sampleCurvature(sketch.mesh(), *path, samples);
}

}  // namespace toile
