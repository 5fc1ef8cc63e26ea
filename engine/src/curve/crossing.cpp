// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace toile {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Segments as good as parallel: the sine of their angle in weights.
constexpr double kParallel = 1e-12;
/// A point this near to a segment, in weights, lies on it.
constexpr double kOnLine = 1e-9;
/// How far past its ends a segment may be met, in parts of itself: rounding of a touching end.
constexpr double kPastEnd = 1e-9;

struct Arcs {
  Arcs(const Mesh& mesh, const SurfacePath& path) {
    start.push_back(0);
    for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
      const Vector3d a = position(mesh, path.points[i]);
      const Vector3d b = position(mesh, path.points[(i + 1) % path.points.size()]);
      start.push_back(start.back() + (b - a).norm());
    }
  }
  [[nodiscard]] double at(std::size_t segment, double t) const {
    return start[segment] + t * (start[segment + 1] - start[segment]);
  }
  std::vector<double> start;
};

class Finder {
 public:
  Finder(const Mesh& mesh, const SurfacePath& a, const SurfacePath& b)
      : mesh_(mesh), a_(a), b_(b), isSelf_(&a == &b) {}

  std::vector<PathMeeting> find() {
    const std::vector<SegmentInFace> ofA = segmentsByFace(a_), ofB = segmentsByFace(b_);
    auto from = ofB.begin();
    for (const auto& [face, i] : ofA) {
      while (from != ofB.end() && from->first < face) ++from;
      for (auto at = from; at != ofB.end() && at->first == face; ++at) meet(i, at->second, face);
    }
    // Paths may touch at a vertex without a common face.
    const auto verticesOf = [](const SurfacePath& path) {
      std::vector<std::pair<VertexId, std::size_t>> found;
      for (std::size_t k = 0; k < path.points.size(); ++k) {
        if (const auto* v = std::get_if<VertexId>(&path.points[k].at)) found.emplace_back(*v, k);
      }
      return found;
    };
    auto pointsOfB = verticesOf(b_);
    std::sort(pointsOfB.begin(), pointsOfB.end());
    for (const auto& [vertex, i] : verticesOf(a_)) {
      auto at =
          std::lower_bound(pointsOfB.begin(), pointsOfB.end(), std::pair(vertex, std::size_t{0}));
      for (; at != pointsOfB.end() && at->first == vertex; ++at) {
        const std::size_t j = at->second;
        if (!isSelf_ || i + 1 < j) add(arcsOfA().start[i], arcsOfB().start[j], a_.points[i]);
      }
    }
    return merged();
  }

 private:
  /// Arc lengths, worked out for paths that come near each other only.
  const Arcs& arcsOfA() {
    if (!arcsA_) arcsA_.emplace(mesh_, a_);
    return *arcsA_;
  }
  const Arcs& arcsOfB() {
    if (!arcsB_) arcsB_.emplace(mesh_, b_);
    return *arcsB_;
  }

  using SegmentInFace = std::pair<FaceId, std::size_t>;

  /// The faces that a path passes, in order, with the segments in them: those of its own, and of a
  /// segment along an edge also the one on the other side.
  [[nodiscard]] std::vector<SegmentInFace> segmentsByFace(const SurfacePath& path) const {
    std::vector<SegmentInFace> row;
    row.reserve(path.faceOfSegment.size());
    for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
      const FaceId own = path.faceOfSegment[i];
      row.emplace_back(own, i);
      const SurfacePoint& p = path.points[i];
      const SurfacePoint& q = path.points[(i + 1) % path.points.size()];
      if (!mayRunAlongEdge(p, q)) continue;
      for (const FaceId face : facesOf(mesh_, p)) {
        if (face != own && touches(mesh_, q, face)) row.emplace_back(face, i);
      }
    }
    std::sort(row.begin(), row.end());
    return row;
  }

  /// Through the inside of a face, or between two edges, no segment runs along an edge.
  static bool mayRunAlongEdge(const SurfacePoint& p, const SurfacePoint& q) {
    using OnEdge = SurfacePoint::OnEdge;
    if (std::holds_alternative<SurfacePoint::InFace>(p.at) ||
        std::holds_alternative<SurfacePoint::InFace>(q.at)) {
      return false;
    }
    const auto *a = std::get_if<OnEdge>(&p.at), *b = std::get_if<OnEdge>(&q.at);
    return a == nullptr || b == nullptr || a->edge == b->edge;
  }

  void meet(std::size_t i, std::size_t j, FaceId face) {
    if (isSelf_) {
      const std::size_t count = a_.faceOfSegment.size();
      if (j <= i + 1 || (a_.closed && i == 0 && j + 1 == count)) return;
    }
    const SurfacePoint& p = a_.points[i];
    const SurfacePoint& p2 = a_.points[(i + 1) % a_.points.size()];
    const SurfacePoint& q = b_.points[j];
    const SurfacePoint& q2 = b_.points[(j + 1) % b_.points.size()];
    const auto weights = [&](const SurfacePoint& s) { return barycentricIn(mesh_, s, face); };
    const auto flat = [&](const SurfacePoint& s) -> Vector2d { return weights(s).head<2>(); };
    const auto cross = [](const Vector2d& u, const Vector2d& v) {
      return u.x() * v.y() - u.y() * v.x();
    };
    const Vector2d u = flat(p2) - flat(p), v = flat(q2) - flat(q), w = flat(q) - flat(p);
    const double determinant = cross(u, v);
    if (std::abs(determinant) <= kParallel * u.norm() * v.norm()) {
      // On one line: the ends of the common part. A segment without length is one end.
      const auto onOther = [&](const SurfacePoint& s, bool ofA, double own) {
        const Vector2d& d = ofA ? v : u;
        const Vector2d from = flat(s) - (ofA ? flat(q) : flat(p));
        const double t = d.squaredNorm() > 0 ? from.dot(d) / d.squaredNorm() : 0;
        if (t < -kPastEnd || t > 1 + kPastEnd) return;
        const double other = std::clamp(t, 0.0, 1.0);
        if ((from - other * d).norm() > kOnLine) return;
        if (ofA) {
          add(arcsOfA().at(i, own), arcsOfB().at(j, other), s);
        } else {
          add(arcsOfA().at(i, other), arcsOfB().at(j, own), s);
        }
      };
      onOther(p, true, 0);
      onOther(p2, true, 1);
      onOther(q, false, 0);
      onOther(q2, false, 1);
      return;
    }
    const double s = cross(w, v) / determinant, t = cross(w, u) / determinant;
    if (s < -kPastEnd || s > 1 + kPastEnd || t < -kPastEnd || t > 1 + kPastEnd) return;
    const double onA = std::clamp(s, 0.0, 1.0), onB = std::clamp(t, 0.0, 1.0);
    add(arcsOfA().at(i, onA), arcsOfB().at(j, onB), pointNear(p, p2, q, q2, onA, i, j, onB, face));
  }

  /// A point of a path where the meeting is as good as there, else the place between.
  SurfacePoint pointNear(const SurfacePoint& p, const SurfacePoint& p2, const SurfacePoint& q,
                         const SurfacePoint& q2, double s, std::size_t i, std::size_t j, double t,
                         FaceId face) {
    const double lengthA = arcsOfA().start[i + 1] - arcsOfA().start[i];
    const double lengthB = arcsOfB().start[j + 1] - arcsOfB().start[j];
    if (t * lengthB < kSameMeeting) return q;
    if ((1 - t) * lengthB < kSameMeeting) return q2;
    if (s * lengthA < kSameMeeting) return p;
    if ((1 - s) * lengthA < kSameMeeting) return p2;
    return makeSurfacePoint(
        mesh_, face, (1 - s) * barycentricIn(mesh_, p, face) + s * barycentricIn(mesh_, p2, face));
  }

  void add(double a, double b, const SurfacePoint& point) { found_.push_back({a, b, point}); }

  std::vector<PathMeeting> merged() {
    const auto distance = [](double x, double y, const Arcs& arcs, bool closed) {
      const double d = std::abs(x - y);
      return closed ? std::min(d, arcs.start.back() - d) : d;
    };
    std::stable_sort(found_.begin(), found_.end(),
                     [](const PathMeeting& x, const PathMeeting& y) { return x.a < y.a; });
    std::vector<PathMeeting> out;
    for (const PathMeeting& m : found_) {
      const bool isKnown = std::any_of(out.begin(), out.end(), [&](const PathMeeting& o) {
        return distance(m.a, o.a, arcsOfA(), a_.closed) < kSameMeeting &&
               distance(m.b, o.b, arcsOfB(), b_.closed) < kSameMeeting;
      });
      if (!isKnown) out.push_back(m);
    }
    return out;
  }

  const Mesh& mesh_;
  const SurfacePath& a_;
  const SurfacePath& b_;
  std::optional<Arcs> arcsA_, arcsB_;
  bool isSelf_;
  std::vector<PathMeeting> found_;
};

}  // namespace

std::vector<PathMeeting> findMeetings(const Mesh& mesh, const SurfacePath& first,
                                      const SurfacePath& second) {
  return Finder(mesh, first, second).find();
}

std::vector<PathMeeting> findSelfMeetings(const Mesh& mesh, const SurfacePath& path) {
  return Finder(mesh, path, path).find();
}

PathFoot nearestOnPath(const Mesh& mesh, const SurfacePath& path, const Vector3d& place) {
  const Arcs arcs(mesh, path);
  PathFoot best{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
    const Vector3d a = position(mesh, path.points[i]);
    const Vector3d d = position(mesh, path.points[(i + 1) % path.points.size()]) - a;
    const double square = d.squaredNorm();
    const double t = square > 0 ? std::clamp((place - a).dot(d) / square, 0.0, 1.0) : 0.0;
    const double distance = (a + t * d - place).norm();
    if (distance < best.distance) best = {arcs.at(i, t), distance};
  }
  return best;
}

}  // namespace toile
