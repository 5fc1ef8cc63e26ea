// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/view.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <optional>

#include "toile/curve/geodesic.h"

namespace toile {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Neighbouring hits whose way on the surface is longer than this many times their distance lie on
/// different limbs, or the line of sight skipped something between them.
constexpr double kJumpRatio = 3;
/// Halvings of a suspicious stretch of the drawing before it counts as a jump.
constexpr int kRefinements = 5;

struct Hit {
  Vector2d drawn;
  SurfacePoint point;
  Vector3d position;
};

class Projection {
 public:
  Projection(const SurfaceIndex& index, const View& view)
      : index_(index), view_(view), linker_({std::shared_ptr<void>(), &index.mesh()}) {}

  std::optional<Hit> hit(const Vector2d& drawn) const {
    const Ray ray = rayThrough(view_, drawn);
    const std::optional<RayHit> found = index_.firstVisibleHit(ray.origin, ray.direction);
    if (!found) return std::nullopt;
    return Hit{drawn, found->point, found->position};
  }

  /// Appends the points after `a` up to and with `b`, with more between them where the surface is
  /// steep. @return whether the way stays on one part of the surface.
  bool continueTo(const Hit& a, const Hit& b, int refinements, std::vector<SurfacePoint>& row) {
    if (isNear(a, b)) {
      row.push_back(b.point);
      return true;
    }
    if (refinements == 0) return false;
    const std::optional<Hit> middle = hit(0.5 * (a.drawn + b.drawn));
    return middle && continueTo(a, *middle, refinements - 1, row) &&
           continueTo(*middle, b, refinements - 1, row);
  }

  bool isNear(const Hit& a, const Hit& b) {
    if (a.point == b.point) return true;
    const Result<SurfacePath> way = linker_.link(a.point, b.point);
    if (!way) return false;
    return length(index_.mesh(), *way) <= kJumpRatio * (b.position - a.position).norm();
  }

 private:
  const SurfaceIndex& index_;
  const View& view_;
  GeodesicLinker linker_;
};

}  // namespace

Ray rayThrough(const View& view, const Vector2d& point) {
  Vector3d forward = view.target - view.eye;
  if (!(forward.norm() > 0)) forward = {0, 1, 0};
  const Vector3d direction = forward.normalized();
  Vector3d right = direction.cross(view.up);
  if (!(right.norm() > 1e-12 * view.up.norm())) right = direction.unitOrthogonal();
  right.normalize();
  const Vector3d up = right.cross(direction);
  const Vector3d place = view.target + point.x() * right + point.y() * up;
  if (view.perspective) return {view.eye, (place - view.eye).normalized()};
  return {place - forward, direction};
}

Result<std::vector<SurfacePoint>> projectFromView(const SurfaceIndex& index, const View& view,
                                                  std::span<const Vector2d> points) {
  Projection projection(index, view);
  std::vector<Hit> hits;
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const std::optional<Hit> hit = projection.hit(points[i])) {
      hits.push_back(*hit);
    } else {
      missing.push_back(i);
    }
  }
  if (!missing.empty()) {
    const Vector2d& first = points[missing.front()];
    return Error{ErrorCode::LeavesSilhouette,
                 fmt::format("{} of {} points miss the model, the first at ({:.1f}, {:.1f}) mm in "
                             "the view; draw within the outline of the model, or go on in a second "
                             "curve from another view",
                             missing.size(), points.size(), first.x(), first.y()),
                 {}};
  }
  std::vector<SurfacePoint> row;
  if (!hits.empty()) row.push_back(hits.front().point);
  for (std::size_t i = 1; i < hits.size(); ++i) {
    if (!projection.continueTo(hits[i - 1], hits[i], kRefinements, row)) {
      const Vector3d& from = hits[i - 1].position;
      const Vector3d& to = hits[i].position;
      return Error{
          ErrorCode::CurveInvalid,
          fmt::format(
              "between ({:.1f}, {:.1f}) and ({:.1f}, {:.1f}) mm in the view the curve jumps "
              "to another part of the model, from ({:.0f}, {:.0f}, {:.0f}) to ({:.0f}, "
              "{:.0f}, {:.0f}) mm; end it there, or draw it from another view",
              hits[i - 1].drawn.x(), hits[i - 1].drawn.y(), hits[i].drawn.x(), hits[i].drawn.y(),
              from.x(), from.y(), from.z(), to.x(), to.y(), to.z()),
          {}};
    }
  }
  return row;
}

ViewProjection projectRunsFromView(const SurfaceIndex& index, const View& view,
                                   std::span<const Vector2d> points) {
  constexpr int kHalvings = 10;
  Projection projection(index, view);
  ViewProjection result;
  ViewRun run;
  std::optional<Hit> last;
  const auto begin = [&](const Hit& hit, double at) {
    run = {};
    run.points.push_back(hit.point);
    run.from = run.to = at;
    last = hit;
  };
  const auto finish = [&] {
    if (run.points.size() > 1) result.runs.push_back(std::move(run));
    run = {};
    last.reset();
  };
  const auto append = [&](const Hit& hit, double at) {
    if (!projection.continueTo(*last, hit, kRefinements, run.points)) return false;
    run.to = at;
    last = hit;
    return true;
  };
  /// The place farthest from `inside` on the way to `outside` that still belongs to it.
  struct Edge {
    Hit hit;
    double at;
  };
  const auto edgeOf = [&](const Hit& inside, double insideAt, const Vector2d& outside,
                          double outsideAt) {
    Edge edge{inside, insideAt};
    Vector2d beyond = outside;
    double beyondAt = outsideAt;
    for (int i = 0; i < kHalvings; ++i) {
      const Vector2d middle = 0.5 * (edge.hit.drawn + beyond);
      const double at = 0.5 * (edge.at + beyondAt);
      const std::optional<Hit> hit = projection.hit(middle);
      if (hit && projection.isNear(edge.hit, *hit)) {
        edge = {*hit, at};
      } else {
        beyond = middle;
        beyondAt = at;
      }
    }
    return edge;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = static_cast<double>(i);
    const std::optional<Hit> hit = projection.hit(points[i]);
    if (last && hit && append(*hit, at)) continue;
    if (last) {
      const Edge edge = edgeOf(*last, at - 1, points[i], at);
      append(edge.hit, edge.at);
      result.cuts.push_back(
          {hit ? ViewCut::Reason::OtherPart : ViewCut::Reason::Silhouette, edge.hit.drawn});
      finish();
    }
    if (!hit) continue;
    if (i == 0) {
      begin(*hit, at);
      continue;
    }
    const Edge edge = edgeOf(*hit, at, points[i - 1], at - 1);
    if (result.cuts.empty() || result.cuts.back().reason != ViewCut::Reason::OtherPart) {
      result.cuts.push_back({ViewCut::Reason::Silhouette, edge.hit.drawn});
    }
    begin(edge.hit, edge.at);
    if (!append(*hit, at)) begin(*hit, at);
  }
  finish();
  return result;
}

}  // namespace toile
