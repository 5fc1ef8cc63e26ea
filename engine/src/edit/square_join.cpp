// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/square_join.h"

#include <algorithm>

#include "edit/middle_line.h"
#include "edit/nodes.h"
#include "toile/curve/tracking.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

/// Sine of the angle below which a link is square.
constexpr double kSquare = 1e-6;
/// The part of a curve that is drawn anew at most, and in how many links: a line that comes to the
/// middle aslant bends into it over so much, a few degrees at each data point.
constexpr double kBend = 0.15;
constexpr int kBendLinks = 8;

/// Where the first link would end if it were so long and square.
std::optional<SurfacePoint> squareEnd(const Sketch& sketch, const WorkCurve& curve, double reach) {
  const Vector3d towards = position(sketch.mesh(), curve.links.front().points[1]);
  return stepSquare(sketch.model(), curve.data.front(), towards, reach);
}

/// The data point up to which the curve may be drawn anew; a control point, one of other lines or
/// the other end stops it. One is added where there is none.
std::size_t bendEnd(const Sketch& sketch, const std::string& id, WorkCurve& curve) {
  const Mesh& mesh = sketch.mesh();
  const std::vector<double> arcs = arcsOf(mesh, curve);
  const double reach = kBend * arcs[curve.linkCount()];
  const DataPoints points(sketch.design());
  const auto isHeld = [&](std::size_t i) {
    const auto sharing = points.curvesAt(toModelPoint(mesh, curve.data[i]));
    return curve.isControl[i] || std::any_of(sharing.begin(), sharing.end(), [&](std::size_t c) {
             return sketch.design().curves[c].id != id;
           });
  };
  std::size_t i = 1;
  while (i + 1 < curve.data.size() && arcs[i] < reach && !isHeld(i)) ++i;
  return arcs[i] <= reach ? i : insertData(mesh, curve, reach);
}

}  // namespace

bool beginsSquare(const Sketch& sketch, const WorkCurve& curve) {
  if (curve.closed || !isOnMiddle(sketch.model(), curve.data.front())) return false;
  const Mesh& mesh = sketch.mesh();
  const double reach = length(mesh, curve.links.front());
  const auto square = squareEnd(sketch, curve, reach);
  return square && (position(mesh, *square) - position(mesh, curve.data[1])).norm() <
                       kSquare * reach + kSameDataPoint;
}

void beginSquare(Sketch& sketch, const std::string& id, WorkCurve& curve) {
  if (curve.closed || !isOnMiddle(sketch.model(), curve.data.front())) return;
  if (beginsSquare(sketch, curve)) return;
  const Mesh& mesh = sketch.mesh();
  WorkCurve rest = curve;
  const std::size_t until = bendEnd(sketch, id, rest);
  const std::vector<double> arcs = arcsOf(mesh, rest);
  const double reach = arcs[until], all = arcs[rest.linkCount()];
  // With its image the first link is one straight line: half as long, the turns are even.
  const double step = 1 / (kBendLinks - 0.5);
  const auto square = squareEnd(sketch, rest, 0.5 * step * reach);
  if (!square) return;
  const Vector3d start = position(mesh, rest.data.front()), end = position(mesh, rest.data[until]);
  const Vector3d leaving = reach * (position(mesh, *square) - start).normalized();
  const double feel = std::min(step * reach, all - reach);
  const Vector3d after = position(mesh, pointAtArc(mesh, rest, arcs, reach + feel));
  const Vector3d arriving = reach * (feel > 0 ? after - end : end - start).normalized();
  WorkCurve made;
  made.push(rest.data.front(), rest.isControl.front(), rest.isCorner.front());
  const auto push = [&](const SurfacePoint& point) {
    const Vector3d place = position(mesh, point);
    const double least =
        std::min((place - end).norm(), (place - position(mesh, made.data.back())).norm());
    if (least > kSameDataPoint) made.push(point, false);
  };
  push(*square);
  if (made.data.size() < 2) return;
  SurfaceTracker tracker(sketch.model().mesh, *square);
  for (int i = 1; i < kBendLinks - 1; ++i) {
    const double t = (i + 0.5) * step, t2 = t * t, t3 = t2 * t;
    push(tracker.moveTo((2 * t3 - 3 * t2 + 1) * start + (t3 - 2 * t2 + t) * leaving +
                        (3 * t2 - 2 * t3) * end + (t3 - t2) * arriving));
  }
  made.push(rest.data[until], rest.isControl[until], rest.isCorner[until]);
  if (!linkAll(sketch.linker(), made)) return;
  if (until + 1 < rest.data.size()) append(made, partOf(rest, until, rest.data.size() - 1));
  curve = std::move(made);
}

}  // namespace toile::detail
