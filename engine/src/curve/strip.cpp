// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace toile::detail {

namespace {

/// A corner is left alone when its other side misses pi by no more: above the rounding of the
/// angles, so that two ways of equal length do not take turns, and below the promised 1e-9.
constexpr double kStraightAngle = 1e-10;
/// A path that passes a vertex at less than this part of the edge goes through it: far below any
/// length that matters, far above rounding.
constexpr double kVertexPart = 1e-11;
/// Sine of the angle below which a path runs along an edge, and the place where it passes over it
/// is not to be had from the distances of the edge's ends.
constexpr double kAlongEdge = 1e-9;
/// Sine of the angle by which rounding may put the end of a path beside a side of the funnel; such
/// a path passes through the side's vertex all the same (kVertexPart).
constexpr double kBesideSide = 1e-12;

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

double angleBetween(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return std::atan2(std::abs(cross(u, v)), u.dot(v));
}

}  // namespace

bool Strip::isOnEdgeOf(const SurfacePoint& point, HalfedgeId h) const {
  if (const auto* v = std::get_if<VertexId>(&point.at)) {
    return mesh_.from(h) == *v || mesh_.to(h) == *v;
  }
  if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    return mesh_.edge(h) == on->edge;
  }
  return false;
}

void Strip::set(const SurfacePoint& start, const SurfacePoint& end,
                const std::vector<HalfedgeId>& crossings) {
  start_ = start;
  end_ = end;
  crossings_.clear();
  for (const HalfedgeId h : crossings) {
    if (!crossings_.empty() && mesh_.opposite(h) == crossings_.back()) {
      crossings_.pop_back();
    } else {
      crossings_.push_back(h);
    }
  }
  std::size_t first = 0, last = crossings_.size();
  while (first < last && isOnEdgeOf(start, crossings_[first])) ++first;
  while (last > first && isOnEdgeOf(end, crossings_[last - 1])) --last;
  crossings_.resize(last);
  crossings_.erase(crossings_.begin(), crossings_.begin() + static_cast<std::ptrdiff_t>(first));
}

void Strip::unfold() {
  portals_.clear();
  const HalfedgeId first = crossings_.front();
  // The corner of the first face nearest to the start is the origin, so that a start close to a
  // vertex keeps its direction from there.
  const FaceId face = mesh_.face(first);
  const Eigen::Vector3d weights = barycentricIn(mesh_, start_, face);
  Eigen::Index nearest = 0;
  weights.maxCoeff(&nearest);
  const HalfedgeId base = mesh_.halfedge(face, static_cast<int>(nearest));
  const FaceGeometry::Apex& apex = geometry_.apex(base);
  const double along = (mesh_.position(mesh_.to(base)) - mesh_.position(mesh_.from(base))).norm();
  const std::array<Point, 3> corner{Point(0, 0), Point(along, 0),
                                    Point(apex.along * along, apex.aside * along)};
  const auto place = [&](int side) {
    return corner[static_cast<std::size_t>((side - static_cast<int>(nearest) + 3) % 3)];
  };
  startPlace_ = weights[(nearest + 1) % 3] * corner[1] + weights[(nearest + 2) % 3] * corner[2];

  const int side = mesh_.side(first);
  Portal portal{place((side + 1) % 3), place(side), mesh_.to(first), mesh_.from(first)};
  portals_.push_back(portal);
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    const HalfedgeId entered = mesh_.opposite(crossings_[i]);
    const FaceGeometry::Apex& third = geometry_.apex(entered);
    // The entered face has its halfedge from the left end to the right end.
    const Point d = portal.right - portal.left;
    const Point top = portal.left + third.along * d + third.aside * Point(-d.y(), d.x());
    if (i + 1 == crossings_.size()) {
      const Eigen::Vector3d w = barycentricIn(mesh_, end_, mesh_.face(entered));
      const int s = mesh_.side(entered);
      endPlace_ = portal.left + w[(s + 1) % 3] * d + w[(s + 2) % 3] * (top - portal.left);
      break;
    }
    const VertexId topVertex = mesh_.from(mesh_.previous(entered));
    if (crossings_[i + 1] == mesh_.next(entered)) {  // leaves between the right end and the top
      portal.left = top;
      portal.leftVertex = topVertex;
    } else {
      portal.right = top;
      portal.rightVertex = topVertex;
    }
    portals_.push_back(portal);
  }
  portals_.push_back({endPlace_, endPlace_, VertexId(), VertexId()});
}

void Strip::pullTight() {
  corners_.clear();
  if (crossings_.empty()) {
    length_ = (position(mesh_, end_) - position(mesh_, start_)).norm();
    return;
  }
  unfold();
  const std::size_t count = portals_.size();  // the last one is the end
  length_ = 0;
  Point tip = startPlace_;
  Point left = portals_[0].left, right = portals_[0].right;
  std::size_t leftPortal = 0, rightPortal = 0;

  // Makes the funnel's side a corner of the path and starts a new funnel there.
  const auto turnAt = [&](bool isLeft) {
    const std::size_t first = isLeft ? leftPortal : rightPortal;
    const auto vertexAt = [&](std::size_t i) {
      return isLeft ? portals_[i].leftVertex : portals_[i].rightVertex;
    };
    const VertexId vertex = vertexAt(first);
    std::size_t last = first;
    while (last + 2 < count && vertexAt(last + 1) == vertex) ++last;
    const Point place = isLeft ? left : right;
    length_ += (place - tip).norm();
    corners_.push_back({vertex, place, isLeft, first, last});
    tip = place;
    left = portals_[last + 1].left;
    right = portals_[last + 1].right;
    leftPortal = rightPortal = last + 1;
    return last + 1;
  };

  // Whether the way must turn at a side of the funnel, by the cross product outwards. Where side
  // and end are in line only if the end is beyond: it may lie on the portal itself.
  const auto isPast = [](const Point& side, const Point& to, double outwards, bool isEnd) {
    if (!isEnd || !(outwards > 0)) return outwards > 0;
    return outwards > kBesideSide * side.norm() * to.norm() || side.dot(to) > side.squaredNorm();
  };

  for (std::size_t i = 1; i < count; ++i) {
    const Portal& portal = portals_[i];
    const bool isEnd = i + 1 == count;
    if (isEnd || portal.rightVertex != portals_[i - 1].rightVertex) {
      const Point to = portal.right - tip;
      if (cross(right - tip, to) >= 0) {
        if (isPast(left - tip, to, cross(left - tip, to), isEnd)) {
          i = turnAt(true);
          continue;
        }
        right = portal.right;
        rightPortal = i;
      }
    }
    if (isEnd || portal.leftVertex != portals_[i - 1].leftVertex) {
      const Point to = portal.left - tip;
      if (cross(left - tip, to) <= 0) {
        if (isPast(right - tip, to, -cross(right - tip, to), isEnd)) {
          i = turnAt(false);
          continue;
        }
        left = portal.left;
        leftPortal = i;
      }
    }
  }
  length_ += (endPlace_ - tip).norm();
}

double Strip::angleOnOtherSide(std::size_t index) const {
  const Corner& corner = corners_[index];
  const Point from = index == 0 ? startPlace_ : corners_[index - 1].place;
  const Point to = index + 1 == corners_.size() ? endPlace_ : corners_[index + 1].place;
  const auto farEnd = [&](std::size_t i) {
    return corner.isLeft ? portals_[i].right : portals_[i].left;
  };
  double inStrip = angleBetween(from - corner.place, farEnd(corner.first) - corner.place) +
                   angleBetween(to - corner.place, farEnd(corner.last) - corner.place);
  for (std::size_t i = corner.first; i < corner.last; ++i) {
    const HalfedgeId entered = mesh_.opposite(crossings_[i]);
    inStrip += geometry_.cornerAngle(corner.isLeft ? entered : mesh_.next(entered));
  }
  return geometry_.angleAround(corner.vertex) - inStrip;
}

bool Strip::appendOtherWay(const Corner& corner, std::vector<HalfedgeId>& row) const {
  const std::size_t before = row.size();
  const FaceId goal = mesh_.face(mesh_.opposite(crossings_[corner.last]));
  HalfedgeId entered = crossings_[corner.first];
  const FaceId from = mesh_.face(entered);
  for (FaceId face = from; face != goal;) {
    const HalfedgeId h = corner.isLeft ? mesh_.next(entered) : mesh_.previous(entered);
    row.push_back(h);
    entered = mesh_.opposite(h);
    face = entered.isValid() ? mesh_.face(entered) : from;
    if (face == from) {  // the border, or once around: there is no other way
      row.resize(before);
      return false;
    }
  }
  return true;
}

int Strip::rerouteCorners() {
  int passed = 0;
  std::vector<HalfedgeId> row;
  std::size_t kept = 0;  // crossings before this one are in the new row
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Corner& corner = corners_[i];
    if (corner.first < kept || mesh_.isBorder(corner.vertex)) continue;
    if (angleOnOtherSide(i) >= std::numbers::pi - kStraightAngle) continue;
    const auto at = [&](std::size_t k) {
      return crossings_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    row.insert(row.end(), at(kept), at(corner.first));
    kept = corner.first;
    if (!appendOtherWay(corner, row)) continue;
    kept = corner.last + 1;
    ++passed;
  }
  if (passed == 0) return 0;
  row.insert(row.end(), crossings_.begin() + static_cast<std::ptrdiff_t>(kept), crossings_.end());
  set(SurfacePoint(start_), SurfacePoint(end_), row);
  return passed;
}

SurfacePoint Strip::pointOnPortal(std::size_t i, const Point& from, const Point& to) const {
  const Portal& portal = portals_[i];
  const Point along = to - from, across = portal.left - portal.right;
  // Distances of the portal's ends from the line; a vertex that several portals share has the same
  // one in all of them, so that a path close to it stays straight across its fan.
  double leftOf = cross(along, portal.left - from);
  double rightOf = -cross(along, portal.right - from);
  if (!(leftOf + rightOf > kAlongEdge * along.norm() * across.norm())) {
    // Along the portal: over it where its ends lie on the two sides of it, or half way.
    const double start = cross(across, from - portal.right), end = cross(across, to - portal.right);
    const double part = start * end < 0 ? start / (start - end) : 0.5;
    rightOf =
        std::clamp((from + part * along - portal.right).dot(across), 0.0, across.squaredNorm());
    leftOf = across.squaredNorm() - rightOf;
  }
  const double sum = leftOf + rightOf;
  if (!(rightOf > kVertexPart * sum)) return {portal.rightVertex};
  if (!(leftOf > kVertexPart * sum)) return {portal.leftVertex};
  const bool fromRight = portal.rightVertex < portal.leftVertex;
  return {SurfacePoint::OnEdge{mesh_.edge(crossings_[i]), (fromRight ? rightOf : leftOf) / sum}};
}

SurfacePath Strip::path() const {
  SurfacePath path;
  path.points.push_back(start_);
  if (crossings_.empty()) {
    path.points.push_back(end_);
    path.faceOfSegment.push_back(commonFace(mesh_, start_, end_));
    return path;
  }
  const auto hasEnd = [&](std::size_t i, VertexId vertex) {
    return portals_[i].leftVertex == vertex || portals_[i].rightVertex == vertex;
  };
  const auto append = [&](const SurfacePoint& point, FaceId face) {
    if (point == path.points.back()) return;
    path.points.push_back(point);
    path.faceOfSegment.push_back(face);
  };
  Point tip = startPlace_;
  std::size_t corner = 0;
  std::size_t open = 0;  // portals from here on may still be passed at a vertex instead
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    const bool hasCorner = corner < corners_.size();
    if (hasCorner && i == corners_[corner].first) {
      append({corners_[corner].vertex}, mesh_.face(crossings_[i]));
      i = corners_[corner].last;
      tip = corners_[corner++].place;
      open = i + 1;
      continue;
    }
    const SurfacePoint point =
        pointOnPortal(i, tip, hasCorner ? corners_[corner].place : endPlace_);
    std::size_t first = i;
    if (const auto* vertex = std::get_if<VertexId>(&point.at)) {
      // All portals that end there are passed there, whatever rounding makes of each of them.
      const std::size_t end = hasCorner ? corners_[corner].first : crossings_.size();
      while (first > open && hasEnd(first - 1, *vertex)) --first;
      path.points.resize(path.points.size() - (i - first), start_);
      path.faceOfSegment.resize(path.faceOfSegment.size() - (i - first));
      while (i + 1 < end && hasEnd(i + 1, *vertex)) ++i;
      open = i + 1;
    }
    append(point, mesh_.face(crossings_[first]));
  }
  append(end_, mesh_.face(mesh_.opposite(crossings_.back())));
  return path;
}

}  // namespace toile::detail
