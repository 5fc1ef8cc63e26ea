// SPDX-License-Identifier: GPL-3.0-or-later
// CurveDrag: one gesture of pulling a curve.
#include <fmt/format.h>

#include <algorithm>

#include "edit/grip.h"
#include "edit/middle_line.h"
#include "edit/nodes.h"
#include "model/mirror.h"
#include "toile/curve/crossing.h"
#include "toile/edit/shape.h"

namespace toile {

using detail::Grip;
using detail::Knot;
using detail::Sketch;
using detail::StretchEnd;
using detail::WorkCurve;
using Eigen::Vector3d;

struct CurveDrag::State {
  State(const Document& d, Sketch::Target t, Grip g, std::size_t h)
      : start(d),
        sketch(d),
        target(std::move(t)),
        grip(std::move(g)),
        handle(h),
        reshaper(*sketch.model().index, sketch.linker()),
        tracker(sketch.model().mesh, grip.curve.data[grip.handles[h]]) {
    made.curve = grip.curve;
    for (std::size_t i = 0; i < grip.curve.data.size(); ++i) made.newIndex.push_back(i);
    const std::size_t data = grip.handles[handle];
    if (grip.curve.closed || (data != 0 && data + 1 != grip.curve.data.size())) return;
    if (isOnMirror(data)) {
      middle.emplace(sketch.model());
    } else {
      findRail();
    }
  }

  /// The curve on which the handle, an end, lies.
  void findRail() {
    const ModelPoint end = toModelPoint(sketch.mesh(), grip.curve.data[grip.handles[handle]]);
    for (const StylingCurve& other : sketch.design().curves) {
      const auto& data = other.dataPoints;
      if (other.id == target.id) continue;
      const auto found = std::find(data.begin(), data.end(), end);
      if (found == data.end()) continue;
      const bool isEnd = !other.closed && (found == data.begin() || found + 1 == data.end());
      if (isEnd) continue;
      const Result<WorkCurve> work = sketch.load(other.id);
      if (!work) continue;
      rail = *work;
      railId = other.id;
      return;
    }
  }

  Result<void> put(SurfacePoint to) {
    const Mesh& mesh = sketch.mesh();
    if (rail) {
      const SurfacePath path = detail::pathOf(*rail);
      const PathFoot foot = nearestOnPath(mesh, path, position(mesh, to));
      to = detail::pointAtArc(mesh, *rail, detail::arcsOf(mesh, *rail), foot.arc);
    }
    if (middle) to = middle->nearest(mesh, position(mesh, to));
    const std::size_t held = grip.handles[handle];
    std::vector<Knot> knots;
    if (grip.handles.front() != grip.first) knots.push_back({grip.first, std::nullopt});
    for (const std::size_t at : grip.handles) {
      Knot knot{at, std::nullopt};
      if (at == held && !(to == grip.curve.data[held])) knot.to = to;
      knots.push_back(knot);
    }
    if (knots.back().data != grip.last) knots.push_back({grip.last, std::nullopt});
    const auto endAt = [&](std::size_t data) {
      if (grip.curve.closed) return StretchEnd::Tangent;
      const bool isOwn = data == 0 || data + 1 == grip.curve.data.size();
      return isOwn && !isOnMirror(data) ? StretchEnd::Place : StretchEnd::Tangent;
    };
    if (knots.size() < 2) {
      return Error{ErrorCode::CurveInvalid, "the stretch has nothing to pull at", {}};
    }
    Result<detail::Reshaper::Reshaped> next =
        reshaper.reshape(grip.curve, knots, endAt(knots.front().data), endAt(knots.back().data));
    if (!next) return next.error().during("curve \"" + target.id + "\"");
    made = *std::move(next);
    for (const std::size_t at : grip.handles) {
      if (at == held) made.curve.isControl[made.newIndex[at]] = true;
    }
    return {};
  }

  /// An end on the middle line of a curve with a live mirror image keeps its direction and slides
  /// along that line, so that both halves join smoothly.
  [[nodiscard]] bool isOnMirror(std::size_t data) const {
    if (sketch.imagesOf(target.id).empty()) return false;
    return detail::isOnMiddle(sketch.model(), grip.curve.data[data]);
  }

  Document start;
  mutable Sketch sketch;
  Sketch::Target target;
  Grip grip;
  std::size_t handle;
  detail::Reshaper reshaper;
  SurfaceTracker tracker;
  detail::Reshaper::Reshaped made;
  std::optional<WorkCurve> rail;
  std::string railId;
  std::optional<detail::MiddleLine> middle;
};

CurveDrag::CurveDrag(std::unique_ptr<State> state) : state_(std::move(state)) {}
CurveDrag::~CurveDrag() = default;
CurveDrag::CurveDrag(CurveDrag&&) noexcept = default;
CurveDrag& CurveDrag::operator=(CurveDrag&&) noexcept = default;

Result<CurveDrag> CurveDrag::begin(const Document& document, const std::string& curve,
                                   const Stretch& stretch, std::size_t handle) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<Grip> grip = detail::gripOf(sketch, *target, curve, stretch);
  if (!grip) return grip.error();
  if (handle >= grip->handles.size()) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("the stretch has {} handles; there is no handle {}",
                             grip->handles.size(), handle),
                 {Element::curve(curve)}};
  }
  if (grip->curve.closed && stretch.from == 0 && stretch.to == 1) detail::openRing(*grip, handle);
  return CurveDrag(std::make_unique<State>(document, *target, *std::move(grip), handle));
}

Result<void> CurveDrag::moveTo(const Vector3d& place) {
  Vector3d goal = place;
  if (state_->target.isMirrored) {
    const Symmetry& symmetry = *state_->sketch.model().symmetry;
    if (symmetry.partner.empty()) {
      goal -= 2 * (symmetry.normal.dot(goal) - symmetry.offset) * symmetry.normal;
    } else {
      // On a body that is not symmetric itself: by what lies below the place.
      const auto below = state_->sketch.model().index->closestPoint(place);
      const Result<SurfacePoint> image = detail::mirrored(state_->sketch.model(), below.point);
      if (!image) return image.error();
      goal = position(state_->sketch.mesh(), *image);
    }
  }
  return state_->put(state_->tracker.moveTo(goal));
}

Result<void> CurveDrag::moveUnder(const Ray& ray) {
  if (!state_->target.isMirrored) return state_->put(state_->tracker.moveUnder(ray));
  // The tracker of the image follows the ray; the original goes to the partner of its point.
  Result<SurfacePoint> image = detail::mirrored(state_->sketch.model(), state_->tracker.at());
  if (!image) return image.error();
  SurfaceTracker other(state_->sketch.model().mesh, *image);
  const Result<SurfacePoint> back = detail::mirrored(state_->sketch.model(), other.moveUnder(ray));
  if (!back) return back.error();
  state_->tracker.restart(*back);
  return state_->put(*back);
}

Result<void> CurveDrag::moveOnto(const SurfacePoint& point) {
  const Result<SurfacePoint> to = state_->sketch.forTarget(state_->target, point);
  if (!to) return to.error();
  state_->tracker.restart(*to);
  return state_->put(*to);
}

SurfacePoint CurveDrag::handle() const {
  const std::size_t at = state_->made.newIndex[state_->grip.handles[state_->handle]];
  const SurfacePoint& point = state_->made.curve.data[at];
  const Result<SurfacePoint> mine = state_->sketch.forTarget(state_->target, point);
  return mine ? *mine : point;
}

SurfacePath CurveDrag::path() const {
  return detail::pathOf(state_->made.curve);
}

Result<Document> CurveDrag::document() const {
  const State& s = *state_;
  Sketch sketch(s.start);
  WorkCurve curve = s.made.curve;
  if (curve.closed && s.grip.turned > 0) {
    const std::size_t n = s.grip.curve.data.size();
    detail::rotate(curve, s.made.newIndex[n - s.grip.turned]);
  }
  std::vector<detail::MovedNode> moved;
  for (std::size_t i = 0; i < s.grip.curve.data.size(); ++i) {
    const SurfacePoint& from = s.grip.curve.data[i];
    const SurfacePoint& to = s.made.curve.data[s.made.newIndex[i]];
    const bool isDragged = i == s.grip.handles[s.handle];
    const bool slides = isDragged && s.rail;
    if (!(from == to)) moved.push_back({from, to, isDragged && !slides, slides ? s.railId : ""});
  }
  if (s.rail) {
    // The place on the rail becomes one of its data points.
    WorkCurve rail = *s.rail;
    const SurfacePoint& end = s.made.curve.data[s.made.newIndex[s.grip.handles[s.handle]]];
    const SurfacePath path = detail::pathOf(rail);
    const PathFoot foot = nearestOnPath(sketch.mesh(), path, position(sketch.mesh(), end));
    const std::size_t at = detail::insertData(sketch.mesh(), rail, foot.arc);
    if (!(rail.data[at] == end)) {
      const bool isFirst = s.made.newIndex[s.grip.handles[s.handle]] == 0;
      (isFirst ? curve.data.front() : curve.data.back()) = rail.data[at];
      (isFirst ? curve.links.front() : curve.links.back()).points.clear();
      const Result<void> linked = detail::linkAll(sketch.linker(), curve);
      if (!linked) return linked.error();
    }
    sketch.store(s.railId, rail);
  }
  const Result<void> followed = detail::followNodes(sketch, s.target.id, curve, moved);
  if (!followed) return followed.error();
  sketch.store(s.target.id, curve);
  return sketch.document();
}

}  // namespace toile
