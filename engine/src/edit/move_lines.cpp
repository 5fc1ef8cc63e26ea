// SPDX-License-Identifier: GPL-3.0-or-later
// Offset, moving, direction and kind of curves.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "edit/middle_line.h"
#include "edit/nodes.h"
#include "edit/parts.h"
#include "toile/curve/crossing.h"
#include "toile/curve/curvature.h"
#include "toile/curve/trace.h"
#include "toile/curve/tracking.h"
#include "toile/edit/lines.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kMaxOffsetPoints = 400;
/// Points of a parallel line that come this much nearer than they should are left out.
constexpr double kTooNear = 0.01;

}  // namespace

Result<Edited> offsetCurve(const Document& document, const std::string& curve, Length distance,
                           const std::string& id) {
  if (!(std::abs(distance.mm()) > 0) || !std::isfinite(distance.mm())) {
    return Error{ErrorCode::InvalidArgument, "a parallel line needs a distance that is not 0", {}};
  }
  Sketch sketch(document);
  Result<WorkCurve> work = sketch.load(curve);
  if (!work) return work.error();
  const Mesh& mesh = sketch.mesh();
  const SurfacePath path = detail::pathOf(*work);
  const double all = length(mesh, path), d = distance.mm();
  const double spacing = std::max({all / static_cast<double>(kMaxOffsetPoints), 0.1 * std::abs(d),
                                   0.5 * mesh.meanEdgeLength()});
  const auto count = static_cast<std::size_t>(std::max(8.0, std::ceil(all / spacing)));
  std::vector<SurfacePoint> points;
  Vector3d lastFoot = Vector3d::Zero(), lastPlace = Vector3d::Zero();
  std::size_t missing = 0;
  for (const CurvatureSample& sample : sampleCurvature(mesh, path, count)) {
    const Vector3d left = sample.normal.cross(sample.tangent);
    const auto trace =
        traceStraight(mesh, sample.point, d > 0 ? left : Vector3d(-left), std::abs(d));
    if (!trace || length(mesh, *trace) < std::abs(d) * (1 - 1e-9)) {
      ++missing;
      continue;
    }
    const SurfacePoint& end = trace->points.back();
    const Vector3d place = position(mesh, end);
    // In a hollow bend the parallel turns back: those points lie nearer to another place.
    const bool turnsBack =
        !points.empty() && (place - lastPlace).dot(sample.position - lastFoot) <= 0;
    const bool isTooNear = nearestOnPath(mesh, path, place).distance <
                           (position(mesh, end) - sample.position).norm() * (1 - kTooNear);
    if (turnsBack || isTooNear) {
      ++missing;
      continue;
    }
    points.push_back(end);
    lastFoot = sample.position;
    lastPlace = place;
  }
  const bool closed = work->closed;
  Result<WorkCurve> made = detail::makeWorkCurve(sketch.linker(), mesh, points, closed);
  if (points.size() < count / 4 || !made) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("there is no parallel to \"{}\" at {:.1f} mm: it leaves the model, or "
                             "the curve bends more tightly",
                             curve, d),
                 {Element::curve(curve)}};
  }
  for (std::size_t i = 0; i < made->data.size(); i += 8) made->isControl[i] = true;
  detail::markEnds(*made);
  StylingCurve copy = sketch.edit(curve);
  copy.id = id.empty() ? sketch.freeId(curve + "-offset") : id;
  copy.name.clear();
  copy.mirrorOf.reset();
  const Result<std::string> added = sketch.add(copy);
  if (!added) return added.error();
  sketch.store(*added, *made);
  Edited edited{sketch.document(), {*added}, {}};
  if (missing > 0) {
    edited.findings.push_back(
        {"offset-shortened",
         fmt::format("{} of {} points of the parallel to \"{}\" were left out: they leave the "
                     "model, or lie in a bend that is tighter than {:.1f} mm",
                     missing, count, curve, std::abs(d)),
         {Element::curve(*added)}});
  }
  return edited;
}

Result<Document> moveCurve(const Document& document, const std::string& curve,
                           const SurfacePoint& from, const SurfacePoint& to) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  const Result<SurfacePoint> start = sketch.forTarget(*target, from);
  const Result<SurfacePoint> end = sketch.forTarget(*target, to);
  if (!start) return start.error();
  if (!end) return end.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  const Mesh& mesh = sketch.mesh();
  const Vector3d way = position(mesh, *end) - position(mesh, *start);
  SurfaceTracker tracker(sketch.model().mesh, *start);
  std::optional<detail::MiddleLine> middle;
  if (!sketch.imagesOf(target->id).empty()) middle.emplace(sketch.model());
  std::vector<SurfacePoint> moved;
  std::vector<bool> onRail(work->data.size(), false);
  for (std::size_t i = 0; i < work->data.size(); ++i) {
    tracker.restart(work->data[i]);
    SurfacePoint point = tracker.moveTo(position(mesh, work->data[i]) + way);
    const bool isEnd = !work->closed && (i == 0 || i + 1 == work->data.size());
    if (isEnd && middle && detail::isOnMiddle(sketch.model(), work->data[i])) {
      point = middle->nearest(mesh, position(mesh, point));
    } else if (isEnd) {
      const ModelPoint was = toModelPoint(mesh, work->data[i]);
      std::vector<std::string> rails;
      for (const StylingCurve& other : sketch.design().curves) {
        if (other.id != target->id && std::find(other.dataPoints.begin(), other.dataPoints.end(),
                                                was) != other.dataPoints.end()) {
          rails.push_back(other.id);
        }
      }
      if (!rails.empty()) {
        Result<WorkCurve> rail = sketch.load(rails.front());
        if (!rail) return rail.error();
        const PathFoot foot = nearestOnPath(mesh, detail::pathOf(*rail), position(mesh, point));
        point = rail->data[detail::insertData(mesh, *rail, foot.arc)];
        sketch.store(rails.front(), *rail);
        onRail[i] = true;
      }
    }
    moved.push_back(point);
  }
  Result<WorkCurve> made = detail::makeWorkCurve(sketch.linker(), mesh, moved, work->closed);
  if (!made) return made.error().during("curve \"" + curve + "\"");
  std::vector<detail::MovedNode> nodes;
  std::size_t next = 0;
  for (std::size_t i = 0; i < work->data.size(); ++i) {
    const auto found = std::find(made->data.begin() + static_cast<std::ptrdiff_t>(next),
                                 made->data.end(), moved[i]);
    // A point that fell on its neighbour is that one now.
    if (found != made->data.end()) {
      next = static_cast<std::size_t>(found - made->data.begin());
      made->isControl[next] = work->isControl[i];
      made->isCorner[next] = work->isCorner[i];
    }
    if (!onRail[i]) nodes.push_back({work->data[i], made->data[next], false});
  }
  const Result<void> followed = detail::followNodes(sketch, target->id, *made, nodes);
  if (!followed) return followed.error();
  sketch.store(target->id, *made);
  return sketch.document();
}

Result<Document> reverseCurve(const Document& document, const std::string& curve) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  detail::reverse(*work);
  const Result<void> stored = detail::storeAndMove(sketch, target->id, *work, [&](double f) {
    return std::optional<Sketch::Moved>({target->id, 1 - f});
  });
  if (!stored) return stored.error();
  std::vector<std::string> turned = sketch.imagesOf(target->id);
  turned.push_back(target->id);
  for (const std::string& id : turned) {
    StylingCurve& styling = sketch.edit(id);
    std::swap(styling.left, styling.right);
  }
  return sketch.document();
}

Result<Document> setCurveKind(const Document& document, const std::string& curve, CurveKind kind) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  std::vector<std::string> ids = sketch.imagesOf(target->id);
  ids.push_back(target->id);
  for (const std::string& id : ids) {
    StylingCurve& styling = sketch.edit(id);
    styling.kind = kind;
    if (kind != CurveKind::Elastic) styling.elasticRange.reset();
  }
  return sketch.document();
}

}  // namespace toile
