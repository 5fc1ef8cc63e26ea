// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/picking.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace toile::studio {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// mm by which a place may lie below what the ray meets and still count as in front.
constexpr double kVisibleSlack = 4;

struct Words {
  Q_DECLARE_TR_FUNCTIONS(Snap)
};

const ReferenceModel& modelOf(const ToolHost& host) {
  return *host.document().model;
}

/// The place of a segment of the screen that is nearest to a pixel, 0..1.
double nearestOnSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d ab = b - a;
  const double squared = ab.squaredNorm();
  return squared == 0 ? 0 : std::clamp((p - a).dot(ab) / squared, 0.0, 1.0);
}

/// A path on the screen, nearest to a pixel, among what passes near the hit on the body.
struct PathPick {
  std::size_t segment = 0;
  double t = 0;
  Vector3d place;
  double pixels = 0;
};
std::optional<PathPick> pickPath(const Screen& screen, const std::vector<Vector3d>& points,
                                 const Vector2d& pixel, double within) {
  std::optional<PathPick> best;
  Vector2d last(0, 0);
  bool hasLast = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Vector2d> here = screen.toPixel(points[i]);
    if (hasLast && here) {
      const double t = nearestOnSegment(pixel, last, *here);
      const double pixels = (last + t * (*here - last) - pixel).norm();
      if (pixels <= within && (!best || pixels < best->pixels)) {
        best = {i - 1, t, (1 - t) * points[i - 1] + t * points[i], pixels};
      }
    }
    hasLast = here.has_value();
    if (here) last = *here;
  }
  return best;
}

LinePick linePick(const ToolHost& host, const PlacedLine& line, const PathPick& pick) {
  const double arc = (1 - pick.t) * line.arc[pick.segment] + pick.t * line.arc[pick.segment + 1];
  return {line.curve.id, pick.segment,
          pick.t,        pointOnSegment(*modelOf(host).mesh, line.path, pick.segment, pick.t),
          pick.place,    line.length() > 0 ? arc / line.length() : 0,
          pick.pixels};
}

/// A place that may catch the pointer.
class Candidates {
 public:
  Candidates(const ToolHost& host, const PointerEvent& event, const RayHit& hit)
      : host_(host), event_(event), hit_(hit) {}

  /// @param rank a lower one wins over a nearer one
  void offer(int rank, SnapMark::Kind kind, const SurfacePoint& point, const QString& word,
             const std::string& curve) {
    const Mesh& mesh = *modelOf(host_).mesh;
    const Vector3d place = position(mesh, point);
    const std::optional<Vector2d> pixel = host_.screen().toPixel(place);
    if (!pixel) return;
    const double pixels = (*pixel - event_.at).norm();
    if (pixels > event_.catchRadius()) return;
    // On the same part of the body: not on the far side of a limb.
    const double reach = 4 * event_.catchRadius() * host_.screen().mmPerPixelAt(place) + 5;
    if ((place - hit_.position).norm() > reach) return;
    if (best_ && (rank > rank_ || (rank == rank_ && pixels >= pixels_))) return;
    rank_ = rank;
    pixels_ = pixels;
    best_ = Snapped{point, place, Vector3d::Zero(), SnapMark{kind, place, word}, curve};
  }

  std::optional<Snapped> best() const { return best_; }

 private:
  const ToolHost& host_;
  const PointerEvent& event_;
  const RayHit& hit_;
  std::optional<Snapped> best_;
  int rank_ = 0;
  double pixels_ = 0;
};

Vector3d normalAt(const Mesh& mesh, const SurfacePoint& point) {
  Vector3d normal = Vector3d::Zero();
  for (const FaceId face : facesOf(mesh, point)) normal += mesh.normal(face);
  return normal.normalized();
}

void offerLine(Candidates& candidates, const ToolHost& host, const PointerEvent& event,
               const PlacedLine& line) {
  const Mesh& mesh = *modelOf(host).mesh;
  const std::string& id = line.curve.id;
  const QString title = QString::fromStdString(line.title());
  if (!line.path.closed) {
    candidates.offer(0, SnapMark::Kind::End, line.path.points.front(), Words::tr("end"), id);
    candidates.offer(0, SnapMark::Kind::End, line.path.points.back(), Words::tr("end"), id);
  }
  const auto pick = pickPath(host.screen(), line.points, event.at, event.catchRadius());
  if (!pick) return;
  candidates.offer(3, SnapMark::Kind::Line, pointOnSegment(mesh, line.path, pick->segment, pick->t),
                   Words::tr("on %1").arg(title), id);
}

}  // namespace

std::optional<RayHit> hitBody(const ToolHost& host, const Vector2d& pixel) {
  const Ray ray = host.screen().rayAt(pixel);
  return modelOf(host).index->firstVisibleHit(ray.origin, ray.direction);
}

bool isVisible(const ToolHost& host, const Vector3d& place, const Vector3d& normal) {
  const Vector3d towards = host.screen().towardsEye(place);
  if (normal.dot(towards) < 0) return false;
  const Ray ray{host.screen().view.eye, place - host.screen().view.eye};
  const auto hit = modelOf(host).index->firstVisibleHit(ray.origin, ray.direction);
  return !hit || hit->t * ray.direction.norm() > ray.direction.norm() - kVisibleSlack;
}

std::optional<LinePick> pickLine(const ToolHost& host, const Vector2d& pixel, double within,
                                 const std::vector<std::string>& except) {
  std::optional<LinePick> best;
  for (const auto& line : host.lines().all()) {
    if (std::ranges::find(except, line->curve.id) != except.end()) continue;
    const auto pick = pickPath(host.screen(), line->points, pixel, best ? best->pixels : within);
    if (!pick || !isVisible(host, pick->place, line->normals[pick->segment])) continue;
    best = linePick(host, *line, *pick);
  }
  return best;
}

LinePick nearestOnLine(const ToolHost& host, const PlacedLine& line, const Vector3d& place) {
  PathPick best{0, 0, line.points.front(), 0};
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const Vector3d way = line.points[i + 1] - line.points[i];
    const double squared = way.squaredNorm();
    const double t =
        squared == 0 ? 0 : std::clamp((place - line.points[i]).dot(way) / squared, 0.0, 1.0);
    const Vector3d foot = line.points[i] + t * way;
    if ((foot - place).norm() >= nearest) continue;
    nearest = (foot - place).norm();
    best = {i, t, foot, 0};
  }
  return linePick(host, line, best);
}

std::vector<std::vector<Vector3d>> middleLines(const ReferenceModel& model) {
  std::vector<std::vector<Vector3d>> lines;
  if (!model.symmetry) return lines;
  const Mesh& mesh = *model.mesh;
  const Symmetry& symmetry = *model.symmetry;
  if (!symmetry.partner.empty()) {
    // The mesh edges between vertices that are their own partners, strung together.
    std::map<VertexId, std::vector<VertexId>> next;
    for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
      const VertexId a = mesh.tail(EdgeId(e)), b = mesh.head(EdgeId(e));
      if (symmetry.partner[a] != a || symmetry.partner[b] != b) continue;
      next[a].push_back(b);
      next[b].push_back(a);
    }
    while (!next.empty()) {
      VertexId at = next.begin()->first;
      for (const auto& [vertex, others] : next) {
        if (others.size() == 1) at = vertex;  // an end, where there is one
      }
      std::vector<Vector3d> line{mesh.position(at)};
      while (next.contains(at)) {
        const VertexId to = next[at].back();
        next[at].pop_back();
        if (next[at].empty()) next.erase(at);
        std::erase(next[to], at);
        if (next[to].empty()) next.erase(to);
        line.push_back(mesh.position(to));
        at = to;
      }
      lines.push_back(std::move(line));
    }
    if (!lines.empty()) return lines;
  }
  for (const SurfacePath& path : model.index->planeSection(symmetry.normal, symmetry.offset)) {
    std::vector<Vector3d> line;
    for (const SurfacePoint& point : path.points) line.push_back(position(mesh, point));
    if (path.closed) line.push_back(line.front());
    lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<Snapped> snap(const ToolHost& host, const PointerEvent& event,
                            const std::vector<std::string>& except) {
  const auto hit = hitBody(host, event.at);
  if (!hit) return std::nullopt;
  const ReferenceModel& model = modelOf(host);
  const Mesh& mesh = *model.mesh;
  Snapped plain{hit->point, hit->position, normalAt(mesh, hit->point), std::nullopt, {}};
  if (event.ctrl || !host.options().snap) return plain;

  Candidates candidates(host, event, *hit);
  for (const auto& line : host.lines().all()) {
    if (std::ranges::find(except, line->curve.id) == except.end()) {
      offerLine(candidates, host, event, *line);
    }
  }
  if (model.symmetry) {
    for (const auto& line : host.middle()) {
      const auto pick = pickPath(host.screen(), line, event.at, event.catchRadius());
      if (!pick) continue;
      candidates.offer(2, SnapMark::Kind::Middle, model.index->closestPoint(pick->place).point,
                       Words::tr("middle"), {});
    }
  }
  for (const auto& [name, path] : model.curves) {
    std::vector<Vector3d> points;
    for (const SurfacePoint& point : path.points) points.push_back(position(mesh, point));
    if (path.closed) points.push_back(points.front());
    const auto pick = pickPath(host.screen(), points, event.at, 0.6 * event.catchRadius());
    if (!pick) continue;
    candidates.offer(4, SnapMark::Kind::ModelCurve,
                     pointOnSegment(mesh, path, pick->segment, pick->t),
                     Words::tr("on %1").arg(QString::fromStdString(name).replace('_', ' ')), {});
  }
  std::optional<Snapped> best = candidates.best();
  if (!best) return plain;
  best->normal = normalAt(mesh, best->point);
  return best;
}

}  // namespace toile::studio
