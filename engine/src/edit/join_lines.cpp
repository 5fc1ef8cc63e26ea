// SPDX-License-Identifier: GPL-3.0-or-later
// Joining, closing and extending of curves.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Ends nearer than this are one place already, mm.
constexpr double kTouching = 1e-3;
constexpr int kBridgeSteps = 16;
/// Radians that a bridge is thought to turn at most: a loop of more would swing out too far.
constexpr double kMostTurn = 1.2 * std::numbers::pi;

/// The way from the end of one curve to the start of the next, smooth at both.
Result<WorkCurve> bridge(Sketch& sketch, const WorkCurve& before, const WorkCurve& after) {
  const Mesh& mesh = sketch.mesh();
  const SurfacePoint &from = before.data.back(), &to = after.data.front();
  const double gap = (position(mesh, to) - position(mesh, from)).norm();
  // Directions along the curves at the gap.
  const auto direction = [&](const WorkCurve& curve, bool atEnd) -> Vector3d {
    const std::vector<double> arcs = detail::arcsOf(mesh, curve);
    const double all = arcs[curve.linkCount()], reach = std::min(gap / 8, all / 4);
    const auto at = [&](double arc) {
      return position(mesh, detail::pointAtArc(mesh, curve, arcs, arc));
    };
    return atEnd ? (at(all) - at(all - reach)).normalized() : (at(reach) - at(0)).normalized();
  };
  const Vector3d start = position(mesh, from), end = position(mesh, to), chord = end - start;
  const Vector3d leaving = direction(before, true), arriving = direction(after, false);
  // A cubic whose speed at the ends is that of a circle's arc that turns so far, within reason.
  const auto angle = [](const Vector3d& u, const Vector3d& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  const double turn = std::min(angle(leaving, chord) + angle(chord, arriving), kMostTurn);
  const double speed = gap / std::pow(std::cos(turn / 4), 2);
  WorkCurve made;
  made.push(from, true);
  SurfaceTracker tracker(sketch.model().mesh, from);
  for (int i = 1; i < kBridgeSteps; ++i) {
    const double t = i / double{kBridgeSteps}, t2 = t * t, t3 = t2 * t;
    const SurfacePoint& point =
        tracker.moveTo((2 * t3 - 3 * t2 + 1) * start + (t3 - 2 * t2 + t) * speed * leaving +
                       (3 * t2 - 2 * t3) * end + (t3 - t2) * speed * arriving);
    if ((position(mesh, point) - position(mesh, made.data.back())).norm() > 0.02 * gap &&
        (position(mesh, point) - end).norm() > 0.02 * gap) {
      made.push(point, false);
    }
  }
  made.push(to, true);
  if (const Result<void> linked = detail::linkAll(sketch.linker(), made); !linked) {
    return linked.error();
  }
  return made;
}

/// The second after the first, bridged where they do not touch.
Result<WorkCurve> joined(Sketch& sketch, WorkCurve first, WorkCurve second) {
  const Mesh& mesh = sketch.mesh();
  const double gap =
      (position(mesh, first.data.back()) - position(mesh, second.data.front())).norm();
  if (gap > kTouching) {
    const Result<WorkCurve> between = bridge(sketch, first, second);
    if (!between) return between.error();
    detail::append(first, *between);
  } else if (!(first.data.back() == second.data.front())) {
    second.data.front() = first.data.back();
    second.links.front().points.clear();
    if (const Result<void> linked = detail::linkAll(sketch.linker(), second); !linked) {
      return linked.error();
    }
  }
  detail::append(first, second);
  return first;
}

Result<void> needOpen(const std::string& id, const WorkCurve& curve) {
  if (!curve.closed) return {};
  return Error{ErrorCode::CurveInvalid,
               fmt::format("curve \"{}\" is closed and has no ends", id),
               {Element::curve(id)}};
}

}  // namespace

Result<Document> joinCurves(const Document& document, const std::string& first,
                            const std::string& second) {
  Sketch sketch(document);
  const auto targetA = sketch.targetOf(first), targetB = sketch.targetOf(second);
  if (!targetA) return targetA.error();
  if (!targetB) return targetB.error();
  if (first == second) return closeCurve(document, first);
  if (targetA->isMirrored && targetB->isMirrored && targetA->id != targetB->id) {
    return joinCurves(document, targetA->id, targetB->id);  // the images follow
  }
  // A live image that is joined with anything else, its original too, is a curve of its own now.
  for (const auto& [id, isMirrored] :
       {std::pair{first, targetA->isMirrored}, std::pair{second, targetB->isMirrored}}) {
    if (!isMirrored) continue;
    const Result<WorkCurve> own = sketch.load(id);
    if (!own) return own.error();
    sketch.store(id, *own);
  }
  Result<WorkCurve> a = sketch.load(first), b = sketch.load(second);
  if (!a) return a.error();
  if (!b) return b.error();
  if (const Result<void> open = needOpen(first, *a); !open) return open.error();
  if (const Result<void> open = needOpen(second, *b); !open) return open.error();
  const Mesh& mesh = sketch.mesh();
  const double lengthA = detail::arcsOf(mesh, *a)[a->linkCount()];
  const double lengthB = detail::arcsOf(mesh, *b)[b->linkCount()];
  // The two ends that lie nearest; the first keeps its direction.
  const auto distance = [&](bool endOfA, bool endOfB) {
    const SurfacePoint& p = endOfA ? a->data.back() : a->data.front();
    const SurfacePoint& q = endOfB ? b->data.back() : b->data.front();
    return (position(mesh, p) - position(mesh, q)).norm();
  };
  const double d[4] = {distance(true, false), distance(true, true), distance(false, true),
                       distance(false, false)};
  const auto best = std::min_element(d, d + 4) - d;
  const bool isAfter = best < 2, isTurned = best == 1 || best == 3;
  if (isTurned) detail::reverse(*b);
  Result<WorkCurve> made = isAfter ? joined(sketch, *a, *b) : joined(sketch, *b, *a);
  if (!made) return made.error();
  const double all = detail::arcsOf(mesh, *made)[made->linkCount()];
  const double startA = isAfter ? 0 : all - lengthA, startB = isAfter ? all - lengthB : 0;
  const auto onto = [&](const std::string& id) {
    return [&, id](double f) {
      const double along = (isTurned ? 1 - f : f) * lengthB;
      return std::optional<Sketch::Moved>({id, std::clamp((startB + along) / all, 0.0, 1.0)});
    };
  };
  if (const Result<void> moved = sketch.moveHangers(second, onto(first)); !moved) {
    return moved.error();
  }
  // Where the first has a live image, that covers the second's; else those stay as they are.
  const std::vector<std::string> images = sketch.imagesOf(first);
  for (const std::string& image : images.empty() ? images : sketch.imagesOf(second)) {
    if (const Result<void> moved = sketch.moveHangers(image, onto(images.front())); !moved) {
      return moved.error();
    }
    if (const Result<void> removed = sketch.remove(image); !removed) return removed.error();
  }
  if (const Result<void> removed = sketch.remove(second); !removed) return removed.error();
  const Result<void> stored = detail::storeAndMove(sketch, first, *made, [&](double f) {
    return std::optional<Sketch::Moved>(
        {first, std::clamp((startA + f * lengthA) / all, 0.0, 1.0)});
  });
  if (!stored) return stored.error();
  return sketch.document();
}

Result<Document> closeCurve(const Document& document, const std::string& curve) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  if (const Result<void> open = needOpen(curve, *work); !open) return open.error();
  const Mesh& mesh = sketch.mesh();
  const double before = detail::arcsOf(mesh, *work)[work->linkCount()];
  const double gap =
      (position(mesh, work->data.back()) - position(mesh, work->data.front())).norm();
  if (gap > kTouching) {
    const Result<WorkCurve> between = bridge(sketch, *work, *work);
    if (!between) return between.error();
    detail::append(*work, *between);
  }
  // The last data point is the first again.
  const SurfacePoint first = work->data.front();
  if (work->data.size() < 4) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("curve \"{}\" has too few points to be closed", curve),
                 {Element::curve(curve)}};
  }
  work->data.pop_back();
  work->isControl.pop_back();
  work->isCorner.pop_back();
  work->closed = true;
  if (!(work->links.back().points.back() == first)) work->links.back().points.clear();
  if (const Result<void> linked = detail::linkAll(sketch.linker(), *work); !linked) {
    return linked.error();
  }
  const double all = detail::arcsOf(mesh, *work)[work->linkCount()];
  const Result<void> stored = detail::storeAndMove(sketch, target->id, *work, [&](double f) {
    return std::optional<Sketch::Moved>({target->id, std::min(1.0, f * before / all)});
  });
  if (!stored) return stored.error();
  return sketch.document();
}

Result<Document> extendToCurve(const Document& document, const std::string& curve, CurveEnd end,
                               const std::string& other, Length limit) {
  if (!(limit.mm() > 0)) {
    return Error{ErrorCode::InvalidArgument, "the limit of an extension must be positive", {}};
  }
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  // The line to meet, as seen from the curve that is changed.
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  Result<WorkCurve> line = sketch.load(other);
  if (!line) return line.error();
  if (const Result<void> open = needOpen(curve, *work); !open) return open.error();
  if (target->isMirrored) {
    for (SurfacePoint& point : line->data) {
      const Result<SurfacePoint> image = sketch.forTarget(*target, point);
      if (!image) return image.error();
      point = *image;
    }
    for (SurfacePath& link : line->links) link.points.clear();
    if (const Result<void> linked = detail::linkAll(sketch.linker(), *line); !linked) {
      return linked.error();
    }
  }
  const Mesh& mesh = sketch.mesh();
  if (end == CurveEnd::Start) detail::reverse(*work);
  const double before = detail::arcsOf(mesh, *work)[work->linkCount()];
  const SurfacePath& last = work->links.back();
  const Vector3d direction =
      position(mesh, last.points.back()) - position(mesh, last.points[last.points.size() - 2]);
  const auto trace = traceStraight(mesh, work->data.back(), direction, limit.mm());
  std::optional<PathMeeting> hit;
  if (trace) {
    for (const PathMeeting& meeting : findMeetings(mesh, *trace, detail::pathOf(*line))) {
      if (meeting.a > kTouching) {
        hit = meeting;
        break;
      }
    }
  }
  if (!hit) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("curve \"{}\", continued straight for {:.0f} mm, does not meet \"{}\"",
                             curve, limit.mm(), other),
                 {Element::curve(curve), Element::curve(other)}};
  }
  const std::size_t at = detail::insertData(mesh, *line, hit->b);
  const SurfacePoint goal = line->data[at];
  work->isControl.back() = true;
  // The trace itself, so that the line goes on straight, to the very point.
  const SurfacePath way = subPath(mesh, *trace, 0, hit->a / length(mesh, *trace));
  work->push(goal, true);
  work->links.emplace_back();
  SurfacePath link = way;
  link.points.back() = goal;
  work->links.back() = isValid(mesh, link) ? link : SurfacePath{};
  if (const Result<void> linked = detail::linkAll(sketch.linker(), *work); !linked) {
    return linked.error();
  }
  const double all = detail::arcsOf(mesh, *work)[work->linkCount()];
  if (end == CurveEnd::Start) detail::reverse(*work);
  const double shift = end == CurveEnd::Start ? all - before : 0;
  const auto otherTarget = sketch.targetOf(other);
  if (otherTarget && !otherTarget->isMirrored && !target->isMirrored) sketch.store(other, *line);
  const Result<void> stored = detail::storeAndMove(sketch, target->id, *work, [&](double f) {
    return std::optional<Sketch::Moved>(
        {target->id, std::clamp((shift + f * before) / all, 0.0, 1.0)});
  });
  if (!stored) return stored.error();
  return sketch.document();
}

}  // namespace toile
