// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/clearance.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

namespace toile {
namespace {

constexpr double kStepsPerMm = 1e4;

/// A polygon's part in a slab: between two edges, at the slab's left and right side.
struct Trapezoid {
  double lowLeft, lowRight, highLeft, highRight;
};

/// With the shift along y: `u` is the coordinate across the slabs, `v` along the shift.
struct Edge {
  double u0, v0, u1, v1;  // u0 < u1
};

std::vector<Edge> edgesAcross(const Points2& polygon, int axis) {
  const int across = 1 - axis;
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d* a = &polygon[i];
    const Eigen::Vector2d* b = &polygon[(i + 1) % polygon.size()];
    if ((*a)[across] > (*b)[across]) std::swap(a, b);
    if ((*a)[across] < (*b)[across])
      edges.push_back({(*a)[across], (*a)[axis], (*b)[across], (*b)[axis]});
  }
  return edges;
}

std::vector<Trapezoid> trapezoids(const std::vector<Edge>& edges, double left, double right) {
  struct Side {
    double left, right;
  };
  std::vector<Side> sides;
  for (const Edge& e : edges) {
    if (e.u0 > left || e.u1 < right) continue;
    const double slope = (e.v1 - e.v0) / (e.u1 - e.u0);
    sides.push_back({e.v0 + slope * (left - e.u0), e.v0 + slope * (right - e.u0)});
  }
  // Edges of a simple polygon do not cross inside the slab: their middles order them.
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.left + a.right < b.left + b.right; });
  std::vector<Trapezoid> parts;
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2)
    parts.push_back({sides[i].left, sides[i].right, sides[i + 1].left, sides[i + 1].right});
  return parts;
}

}  // namespace

Points2 grown(const Points2& polygon, double distance, double tolerance) {
  const double arc = 0.5 * tolerance;
  const std::vector<char> keep(polygon.size(), 0);
  ClipperLib::Path path;
  for (const std::size_t i : simplifiedIndices(polygon, keep, tolerance))
    path.emplace_back(static_cast<ClipperLib::cInt>(std::llround(polygon[i].x() * kStepsPerMm)),
                      static_cast<ClipperLib::cInt>(std::llround(polygon[i].y() * kStepsPerMm)));
  ClipperLib::ClipperOffset offset(2, arc * kStepsPerMm);
  offset.AddPath(path, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  offset.Execute(result, (distance + tolerance + arc) * kStepsPerMm);
  Points2 best;
  for (const ClipperLib::Path& loop : result) {
    Points2 points;
    for (const ClipperLib::IntPoint& p : loop)
      points.emplace_back(static_cast<double>(p.X) / kStepsPerMm,
                          static_cast<double>(p.Y) / kStepsPerMm);
    if (signedArea(points) > signedArea(best)) best = std::move(points);
  }
  return best.empty() ? polygon : best;
}

void addBlockedShifts(const Points2& moving, const Points2& fixed, int axis,
                      std::vector<ShiftRange>& blocked) {
  const int across = 1 - axis;
  const Box2 a = boxOf(moving);
  const Box2 b = boxOf(fixed);
  const double from = std::max(a.min[across], b.min[across]);
  const double to = std::min(a.max[across], b.max[across]);
  if (from >= to) return;
  std::vector<double> cuts{from, to};
  for (const Points2* polygon : {&moving, &fixed})
    for (const Eigen::Vector2d& p : *polygon)
      if (p[across] > from && p[across] < to) cuts.push_back(p[across]);
  std::sort(cuts.begin(), cuts.end());
  const std::vector<Edge> edgesA = edgesAcross(moving, axis);
  const std::vector<Edge> edgesB = edgesAcross(fixed, axis);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i] == cuts[i + 1]) continue;
    const std::vector<Trapezoid> partsB = trapezoids(edgesB, cuts[i], cuts[i + 1]);
    for (const Trapezoid& p : trapezoids(edgesA, cuts[i], cuts[i + 1]))
      for (const Trapezoid& q : partsB)
        // For each place in the slab the blocked shifts are an interval that varies continuously,
        // so their union over the slab is one, too.
        blocked.push_back({std::min(q.lowLeft - p.highLeft, q.lowRight - p.highRight),
                           std::max(q.highLeft - p.lowLeft, q.highRight - p.lowRight)});
  }
}

double leastFreeShift(std::vector<ShiftRange> blocked) {
  std::sort(blocked.begin(), blocked.end(),
            [](const ShiftRange& a, const ShiftRange& b) { return a.from < b.from; });
  double free = 0;
  for (const ShiftRange& range : blocked)
    if (range.from < free + 1e-9 && range.to > free + 1e-9) free = range.to;
  return free;
}

double distanceBetween(const Points2& a, const Points2& b) {
  if (isInside({a}, b.front()) || isInside({b}, a.front())) return 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d& p = a[i];
    const Eigen::Vector2d d = a[(i + 1) % a.size()] - p;
    const Eigen::Vector2d low = p.cwiseMin(p + d);
    const Eigen::Vector2d high = p.cwiseMax(p + d);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Eigen::Vector2d& q = b[j];
      const Eigen::Vector2d& r = b[(j + 1) % b.size()];
      if (std::max(q.x(), r.x()) < low.x() || std::min(q.x(), r.x()) > high.x() ||
          std::max(q.y(), r.y()) < low.y() || std::min(q.y(), r.y()) > high.y())
        continue;
      const double sideQ = cross(d, q - p);
      const double sideR = cross(d, r - p);
      const Eigen::Vector2d e = r - q;
      const double sideP = cross(e, p - q);
      const double sideEnd = cross(e, p + d - q);
      if (((sideQ <= 0 && sideR >= 0) || (sideQ >= 0 && sideR <= 0)) &&
          ((sideP <= 0 && sideEnd >= 0) || (sideP >= 0 && sideEnd <= 0)))
        return 0;
    }
  }
  // Lines that do not cross are nearest at a vertex of one of them.
  const EdgeGrid gridA({a});
  const EdgeGrid gridB({b});
  double least = gridA.nearest(b.front()).distance;
  for (const Eigen::Vector2d& p : a) least = std::min(least, gridB.nearest(p).distance);
  for (const Eigen::Vector2d& p : b) least = std::min(least, gridA.nearest(p).distance);
  return least;
}

std::optional<Eigen::Vector2d> findSelfCrossing(const Points2& polygon) {
  struct Segment {
    Eigen::Vector2d a, b;
    [[nodiscard]] double left() const { return std::min(a.x(), b.x()); }
    [[nodiscard]] double right() const { return std::max(a.x(), b.x()); }
    /// Twice the area of the triangle with a point: its sign is the side.
    [[nodiscard]] double side(const Eigen::Vector2d& p) const { return cross(b - a, p - a); }
  };
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  std::sort(segments.begin(), segments.end(),
            [](const Segment& s, const Segment& t) { return s.left() < t.left(); });
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    for (std::size_t j = i + 1; j < segments.size() && segments[j].left() < s.right(); ++j) {
      const Segment& t = segments[j];
      const double before = s.side(t.a);
      const double after = s.side(t.b);
      if (before * after < 0 && t.side(s.a) * t.side(s.b) < 0)
        return t.a + before / (before - after) * (t.b - t.a);
    }
  }
  return std::nullopt;
}

}  // namespace toile
