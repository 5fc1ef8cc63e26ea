// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/work_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace toile::detail {

void WorkCurve::push(const SurfacePoint& point, bool control, bool corner) {
  data.push_back(point);
  isControl.push_back(control);
  isCorner.push_back(corner);
}

Result<void> linkAll(GeodesicLinker& linker, WorkCurve& curve) {
  const std::size_t count = curve.data.size() - (curve.closed ? 0 : 1);
  curve.links.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePath& old = curve.links[i];
    if (!old.points.empty() && old.points.front() == curve.from(i) &&
        old.points.back() == curve.to(i)) {
      continue;
    }
    Result<SurfacePath> link = linker.link(curve.from(i), curve.to(i));
    if (!link) return link.error();
    curve.links[i] = *std::move(link);
  }
  return {};
}

Result<WorkCurve> makeWorkCurve(GeodesicLinker& linker, const Mesh& mesh,
                                std::span<const SurfacePoint> points, bool closed) {
  WorkCurve curve;
  curve.closed = closed;
  const auto isSame = [&](const SurfacePoint& a, const SurfacePoint& b) {
    return a == b || (position(mesh, a) - position(mesh, b)).norm() < kSameDataPoint;
  };
  for (const SurfacePoint& point : points) {
    if (curve.data.empty() || !isSame(curve.data.back(), point)) curve.push(point, false);
  }
  while (closed && curve.data.size() > 1 && isSame(curve.data.front(), curve.data.back())) {
    curve.data.pop_back();
    curve.isControl.pop_back();
    curve.isCorner.pop_back();
  }
  if (!closed && curve.data.size() > 1) curve.data.back() = points.back();
  const std::size_t needed = closed ? 3 : 2;
  if (curve.data.size() < needed) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("{} different points are too few: {} curve needs {}",
                             curve.data.size(), closed ? "a closed" : "an open", needed),
                 {}};
  }
  if (const Result<void> linked = linkAll(linker, curve); !linked) return linked.error();
  return curve;
}

SurfacePath pathOf(const WorkCurve& curve) {
  SurfacePath path;
  path.closed = curve.closed;
  path.points.push_back(curve.data.front());
  for (const SurfacePath& link : curve.links) {
    path.points.insert(path.points.end(), link.points.begin() + 1, link.points.end());
    path.faceOfSegment.insert(path.faceOfSegment.end(), link.faceOfSegment.begin(),
                              link.faceOfSegment.end());
  }
  if (curve.closed) path.points.pop_back();
  return path;
}

std::vector<double> arcsOf(const Mesh& mesh, const WorkCurve& curve) {
  std::vector<double> arcs{0};
  for (const SurfacePath& link : curve.links) arcs.push_back(arcs.back() + length(mesh, link));
  if (!curve.closed) arcs.push_back(arcs.back());
  return arcs;
}

namespace {

struct LinkPlace {
  std::size_t link = 0;
  double along = 0;  ///< fraction of the link
};

LinkPlace placeAt(const WorkCurve& curve, const std::vector<double>& arcs, double arc) {
  const std::size_t count = curve.linkCount();
  const double all = arcs[count];
  if (curve.closed) arc -= all * std::floor(arc / all);
  arc = std::clamp(arc, 0.0, all);
  const auto above =
      std::upper_bound(arcs.begin() + 1, arcs.begin() + static_cast<std::ptrdiff_t>(count), arc);
  const auto link = static_cast<std::size_t>(above - arcs.begin()) - 1;
  const double span = arcs[link + 1] - arcs[link];
  return {link, span > 0 ? std::clamp((arc - arcs[link]) / span, 0.0, 1.0) : 0.0};
}

}  // namespace

SurfacePoint pointAtArc(const Mesh& mesh, const WorkCurve& curve, const std::vector<double>& arcs,
                        double arc) {
  const LinkPlace place = placeAt(curve, arcs, arc);
  if (place.along <= 0) return curve.from(place.link);
  if (place.along >= 1) return curve.to(place.link);
  return pointAtFraction(mesh, curve.links[place.link], place.along);
}

std::size_t insertData(const Mesh& mesh, WorkCurve& curve, double arc) {
  const std::vector<double> arcs = arcsOf(mesh, curve);
  const LinkPlace place = placeAt(curve, arcs, arc);
  const double span = arcs[place.link + 1] - arcs[place.link];
  if (place.along * span < kSameDataPoint) return place.link;
  if ((1 - place.along) * span < kSameDataPoint) return (place.link + 1) % curve.data.size();
  // Parted by hand: subPath() leaves out segments without length at its ends, and with them the
  // data point itself.
  const SurfacePath whole = curve.links[place.link];
  const SurfacePoint point = pointAtFraction(mesh, whole, place.along);
  std::size_t segment = 0;
  double before = 0;
  while (segment + 1 < whole.faceOfSegment.size()) {
    before +=
        (position(mesh, whole.points[segment + 1]) - position(mesh, whole.points[segment])).norm();
    if (before > place.along * span) break;
    ++segment;
  }
  if (!touches(mesh, point, whole.faceOfSegment[segment])) {  // rounding: it is a neighbour's
    const std::size_t next = segment + 1;
    const bool isNext =
        next < whole.faceOfSegment.size() && touches(mesh, point, whole.faceOfSegment[next]);
    while (!isNext && segment > 0 && !touches(mesh, point, whole.faceOfSegment[segment])) --segment;
    if (isNext) segment = next;
  }
  SurfacePath first, second;
  const auto step = [](SurfacePath& path, const SurfacePoint& next, FaceId face) {
    if (!path.points.empty() && path.points.back() == next) return;
    if (!path.points.empty()) path.faceOfSegment.push_back(face);
    path.points.push_back(next);
  };
  for (std::size_t i = 0; i <= segment; ++i) {
    step(first, whole.points[i], i > 0 ? whole.faceOfSegment[i - 1] : FaceId());
  }
  step(first, point, whole.faceOfSegment[segment]);
  step(second, point, FaceId());
  for (std::size_t i = segment + 1; i < whole.points.size(); ++i) {
    step(second, whole.points[i], whole.faceOfSegment[i - 1]);
  }
  const auto at = static_cast<std::ptrdiff_t>(place.link);
  curve.links[place.link] = first;
  curve.links.insert(curve.links.begin() + at + 1, second);
  curve.data.insert(curve.data.begin() + at + 1, point);
  curve.isControl.insert(curve.isControl.begin() + at + 1, false);
  curve.isCorner.insert(curve.isCorner.begin() + at + 1, false);
  return place.link + 1;
}

namespace {

/// Links of fewer segments are the shortest of all.
constexpr std::size_t kShortLink = 6;
constexpr int kMostHalvings = 10;
/// Ways that are nowhere farther apart are the same, mm.
constexpr double kSameWay = 1e-6;

bool isSameWay(const Mesh& mesh, const SurfacePath& a, const SurfacePath& b) {
  if (a.points == b.points && a.faceOfSegment == b.faceOfSegment) return true;
  if (std::abs(length(mesh, a) - length(mesh, b)) > kSameWay) return false;
  for (const double f : {0.25, 0.5, 0.75}) {
    const double off =
        (position(mesh, pointAtFraction(mesh, a, f)) - position(mesh, pointAtFraction(mesh, b, f)))
            .norm();
    if (off > kSameWay) return false;
  }
  return true;
}

}  // namespace

void settle(GeodesicLinker& linker, const Mesh& mesh, WorkCurve& curve, Links links) {
  const std::size_t least = links == Links::All ? 2 : kShortLink;
  // A closed curve has three data points at least.
  while (curve.closed && curve.data.size() < 3 && curve.linkCount() == curve.data.size()) {
    const std::vector<double> arcs = arcsOf(mesh, curve);
    std::size_t longest = 0;
    for (std::size_t i = 1; i < curve.linkCount(); ++i) {
      if (arcs[i + 1] - arcs[i] > arcs[longest + 1] - arcs[longest]) longest = i;
    }
    const std::size_t before = curve.data.size();
    insertData(mesh, curve, 0.5 * (arcs[longest] + arcs[longest + 1]));
    if (curve.data.size() == before) break;
  }
  for (int round = 0; round < kMostHalvings; ++round) {
    std::vector<double> halves;
    const std::vector<double> arcs = arcsOf(mesh, curve);
    for (std::size_t i = 0; i < curve.linkCount(); ++i) {
      if (curve.links[i].faceOfSegment.size() < least) continue;
      Result<SurfacePath> again = linker.link(curve.from(i), curve.to(i));
      if (again && isSameWay(mesh, curve.links[i], *again)) {
        curve.links[i] = *std::move(again);
      } else {
        halves.push_back(0.5 * (arcs[i] + arcs[i + 1]));
      }
    }
    if (halves.empty()) return;
    for (const double arc : halves) insertData(mesh, curve, arc);
  }
}

namespace {

/// Where a data point is the next one too, bit for bit: one of them goes, with the link between
/// them. Two are left in any case.
void joinWithNext(WorkCurve& curve, std::size_t index) {
  const std::size_t n = curve.data.size(), next = (index + 1) % n;
  const bool hasNext = curve.closed || index + 1 < n;
  if (!hasNext || n <= 2 || !(curve.data[index] == curve.data[next])) return;
  curve.isControl[next] = curve.isControl[next] || curve.isControl[index];
  curve.isCorner[next] = curve.isCorner[next] || curve.isCorner[index];
  const auto at = static_cast<std::ptrdiff_t>(index);
  curve.data.erase(curve.data.begin() + at);
  curve.isControl.erase(curve.isControl.begin() + at);
  curve.isCorner.erase(curve.isCorner.begin() + at);
  curve.links.erase(curve.links.begin() + at);
}

void joinRepeated(WorkCurve& curve, std::size_t index) {
  joinWithNext(curve, index);
  const std::size_t n = curve.data.size();
  joinWithNext(curve, (index + n - 1) % n);
}

}  // namespace

bool nudgeData(const Mesh& mesh, WorkCurve& curve, std::size_t index, const SurfacePoint& point) {
  std::vector<std::pair<std::size_t, SurfacePath>> made;
  for (std::size_t i = 0; i < curve.linkCount(); ++i) {
    const bool isFrom = i == index, isTo = (i + 1) % curve.data.size() == index;
    if (!isFrom && !isTo) continue;
    SurfacePath link = curve.links[i];
    // Rounding may have put the point just into the next face.
    const auto refit = [&](const SurfacePoint& neighbour, FaceId& face) {
      if (!touches(mesh, point, face)) face = commonFace(mesh, neighbour, point);
    };
    if (isFrom) {
      link.points.front() = point;
      refit(link.points[1], link.faceOfSegment.front());
    }
    if (isTo) {
      link.points.back() = point;
      refit(link.points[link.points.size() - 2], link.faceOfSegment.back());
    }
    const bool isWhole = std::all_of(link.faceOfSegment.begin(), link.faceOfSegment.end(),
                                     [](FaceId face) { return face.isValid(); });
    if (!isWhole || !isValid(mesh, link)) return false;
    made.emplace_back(i, std::move(link));
  }
  for (auto& [i, link] : made) curve.links[i] = std::move(link);
  curve.data[index] = point;
  joinRepeated(curve, index);
  return true;
}

Result<void> replaceData(GeodesicLinker& linker, const Mesh& mesh, WorkCurve& curve,
                         std::size_t index, const SurfacePoint& point) {
  if (nudgeData(mesh, curve, index, point)) return {};
  curve.data[index] = point;
  joinRepeated(curve, index);
  return linkAll(linker, curve);
}

void rotate(WorkCurve& curve, std::size_t start) {
  const auto by = static_cast<std::ptrdiff_t>(start);
  std::rotate(curve.data.begin(), curve.data.begin() + by, curve.data.end());
  std::rotate(curve.links.begin(), curve.links.begin() + by, curve.links.end());
  std::rotate(curve.isControl.begin(), curve.isControl.begin() + by, curve.isControl.end());
  std::rotate(curve.isCorner.begin(), curve.isCorner.begin() + by, curve.isCorner.end());
}

void reverse(WorkCurve& curve) {
  for (SurfacePath& link : curve.links) {
    std::reverse(link.points.begin(), link.points.end());
    std::reverse(link.faceOfSegment.begin(), link.faceOfSegment.end());
  }
  std::reverse(curve.links.begin(), curve.links.end());
  // A closed curve keeps its first point.
  const std::ptrdiff_t first = curve.closed ? 1 : 0;
  std::reverse(curve.data.begin() + first, curve.data.end());
  std::reverse(curve.isControl.begin() + first, curve.isControl.end());
  std::reverse(curve.isCorner.begin() + first, curve.isCorner.end());
}

WorkCurve partOf(const WorkCurve& curve, std::size_t from, std::size_t to) {
  const std::size_t n = curve.data.size();
  const std::size_t count = to > from ? to - from : to + n - from;
  WorkCurve part;
  for (std::size_t i = 0; i <= count; ++i) {
    const std::size_t at = (from + i) % n;
    part.push(curve.data[at], curve.isControl[at], curve.isCorner[at]);
    if (i < count) part.links.push_back(curve.links[at]);
  }
  return part;
}

void append(WorkCurve& first, const WorkCurve& second) {
  for (std::size_t i = 1; i < second.data.size(); ++i) {
    first.push(second.data[i], second.isControl[i], second.isCorner[i]);
  }
  first.links.insert(first.links.end(), second.links.begin(), second.links.end());
}

}  // namespace toile::detail
