// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/edit/shape.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "design/mirror.h"
#include "edit/nodes.h"
#include "edit/sketch.h"
#include "toile/curve/crossing.h"

namespace toile {

using detail::Knot;
using detail::Sketch;
using detail::StretchEnd;
using detail::WorkCurve;
using Eigen::Vector3d;

namespace {

/// The end of a stretch goes to the next data point outwards, unless that is farther than this part
/// of the stretch; then one is made.
constexpr double kSnapPart = 0.25;

/// A stretch as data points: `turned` is where the closed curve was rotated to.
struct Grip {
  WorkCurve curve;
  std::size_t turned = 0;
  std::vector<std::size_t> handles;  ///< data points, ascending; ends of the stretch are not among
                                     ///< them unless they are ends of the curve
  std::size_t first = 0, last = 0;   ///< data points
};

double turningBetween(const Mesh& mesh, const WorkCurve& curve, std::size_t first,
                      std::size_t last) {
  double turning = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vector3d a = position(mesh, curve.data[i]) - position(mesh, curve.data[i - 1]);
    const Vector3d b = position(mesh, curve.data[i + 1]) - position(mesh, curve.data[i]);
    turning += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return turning;
}

/// Takes hold of a stretch.
Result<Grip> take(const Mesh& mesh, WorkCurve curve, const Stretch& stretch) {
  for (const double f : {stretch.from, stretch.to}) {
    if (const Result<double> checked = detail::checkedFraction(f); !checked) return checked.error();
  }
  if (stretch.from == stretch.to || (!curve.closed && stretch.to < stretch.from)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("a stretch runs from one fraction to a larger one, not from {} to {}",
                             stretch.from, stretch.to),
                 {}};
  }
  Grip grip;
  const bool isWhole = stretch.from == 0 && stretch.to == 1;
  const double all = detail::arcsOf(mesh, curve)[curve.linkCount()];
  double from = stretch.from * all, to = stretch.to * all;
  if (curve.closed && to < from) to += all;
  const double size = to - from;
  // Outwards to a data point that is there, or a new one.
  const auto dataAt = [&](double arc, bool outwardIsBack) {
    const double on = curve.closed ? arc - all * std::floor(arc / all) : arc;
    const std::vector<double> arcs = detail::arcsOf(mesh, curve);
    const std::size_t n = curve.data.size(), count = curve.linkCount();
    const auto above =
        std::upper_bound(arcs.begin() + 1, arcs.begin() + static_cast<std::ptrdiff_t>(count),
                         on + (outwardIsBack ? detail::kSameDataPoint : -detail::kSameDataPoint));
    const auto link = static_cast<std::size_t>(above - arcs.begin()) - 1;
    const std::size_t outer = outwardIsBack ? link : link + 1;
    if (std::abs(arcs[outer] - on) <= kSnapPart * size) return outer % n;
    return detail::insertData(mesh, curve, on);
  };
  if (isWhole) {
    grip.first = 0;
    grip.last = curve.data.size() - 1;
  } else if (!curve.closed) {
    // Inserting moves later indices: the later end first.
    const std::size_t before = curve.data.size();
    grip.last = dataAt(to, false);
    const std::size_t between = curve.data.size();
    grip.first = dataAt(from, true);
    grip.last += curve.data.size() - between;
    (void)before;
  } else {
    const SurfacePoint lastPoint = curve.data[dataAt(to, false)];
    const std::size_t first = dataAt(from, true);
    detail::rotate(curve, first);
    grip.turned = first;
    grip.first = 0;
    const auto found = std::find(curve.data.begin() + 1, curve.data.end(), lastPoint);
    grip.last = found == curve.data.end() ? curve.data.size() - 1
                                          : static_cast<std::size_t>(found - curve.data.begin());
  }
  if (grip.last <= grip.first) {
    return Error{ErrorCode::InvalidArgument, "the stretch has no length; take a longer one", {}};
  }

  const bool ownFirst = !curve.closed && grip.first == 0;
  const bool ownLast = !curve.closed && grip.last + 1 == curve.data.size();
  bool hasControls = false;
  for (std::size_t i = grip.first + 1; i < grip.last; ++i) {
    hasControls = hasControls || curve.isControl[i];
  }
  if (!hasControls) {
    const double turning = turningBetween(mesh, curve, grip.first, grip.last);
    const int count = turning < std::numbers::pi / 2 ? 4 : turning < std::numbers::pi ? 5 : 6;
    const bool isRing = isWhole && curve.closed;
    std::vector<double> arcs = detail::arcsOf(mesh, curve);
    const double begin = arcs[grip.first];
    const double span = (isRing ? arcs[curve.linkCount()] : arcs[grip.last]) - begin;
    const std::vector<std::size_t> none;
    for (int k = 1; k <= count; ++k) {
      const std::size_t size0 = curve.data.size();
      const double arc = begin + span * k / (count + (isRing ? 0 : 1));
      if (isRing && k == count) continue;  // the start of the ring is its last handle
      // An even sample takes a data point that is there, if it lies near.
      arcs = detail::arcsOf(mesh, curve);
      const auto next = std::lower_bound(
          arcs.begin(), arcs.begin() + static_cast<std::ptrdiff_t>(curve.linkCount()), arc);
      auto at = static_cast<std::size_t>(next - arcs.begin());
      if (at > 0 && arc - arcs[at - 1] < arcs[at] - arc) --at;
      if (std::abs(arcs[at] - arc) > 0.1 * span / count || at <= grip.first || at >= grip.last) {
        at = detail::insertData(mesh, curve, arc);
      }
      grip.last += curve.data.size() - size0;
      if (at > grip.first && at < grip.last + (isRing ? 1U : 0U) &&
          (grip.handles.empty() || grip.handles.back() < at)) {
        grip.handles.push_back(at);
      }
    }
  } else {
    for (std::size_t i = grip.first + 1; i < grip.last; ++i) {
      if (curve.isControl[i]) grip.handles.push_back(i);
    }
  }
  const bool isRing = isWhole && curve.closed;
  if (ownFirst || isRing) grip.handles.insert(grip.handles.begin(), grip.first);
  if (ownLast || (isRing && curve.isControl[grip.last])) grip.handles.push_back(grip.last);
  grip.curve = std::move(curve);
  return grip;
}

/// Of two neighbouring handles that are pulled, a ring is opened opposite to the pulled one.
void openRing(Grip& grip, std::size_t& handle) {
  WorkCurve& curve = grip.curve;
  const std::size_t n = curve.data.size();
  const std::size_t held = grip.handles[handle];
  const std::size_t start = grip.handles[(handle + grip.handles.size() / 2) % grip.handles.size()];
  detail::rotate(curve, start);
  grip.turned = (grip.turned + start) % n;
  for (std::size_t& at : grip.handles) at = (at + n - start) % n;
  std::sort(grip.handles.begin(), grip.handles.end());
  const std::size_t now = (held + n - start) % n;
  // The start, doubled: first and last knot of the stretch are one place, which stays.
  grip.first = 0;
  grip.last = n - 1;
  grip.handles.erase(std::remove(grip.handles.begin(), grip.handles.end(), std::size_t{0}),
                     grip.handles.end());
  handle = static_cast<std::size_t>(std::find(grip.handles.begin(), grip.handles.end(), now) -
                                    grip.handles.begin());
}

/// The stretch of a curve of the document, or of the curve that it mirrors.
Result<Grip> gripOf(Sketch& sketch, const Sketch::Target& target, const std::string& curve,
                    const Stretch& stretch) {
  Result<WorkCurve> work = sketch.load(target.id);
  if (!work) return work.error();
  Result<Grip> grip = take(sketch.mesh(), *std::move(work), stretch);
  if (!grip) return grip.error().during("curve \"" + curve + "\"");
  return grip;
}

}  // namespace

Result<std::vector<Handle>> handlesOf(const Document& document, const std::string& curve,
                                      const Stretch& stretch) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<Grip> grip = gripOf(sketch, *target, curve, stretch);
  if (!grip) return grip.error();
  const std::vector<double> arcs = detail::arcsOf(sketch.mesh(), grip->curve);
  const double all = arcs[grip->curve.linkCount()];
  double turnedArc = 0;
  if (grip->turned > 0) turnedArc = arcs[grip->curve.data.size() - grip->turned];
  std::vector<Handle> handles;
  for (const std::size_t at : grip->handles) {
    double arc = arcs[at] - turnedArc;
    if (arc < 0) arc += all;
    Result<SurfacePoint> point = sketch.forTarget(*target, grip->curve.data[at]);
    if (!point) return point.error();
    handles.push_back({std::clamp(arc / all, 0.0, 1.0), *point, grip->curve.isControl[at]});
  }
  return handles;
}

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
    if (!grip.curve.closed && (data == 0 || data + 1 == grip.curve.data.size())) findRail();
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

  /// An end on the middle line of a curve with a live mirror image keeps its direction, so that
  /// both halves join smoothly.
  [[nodiscard]] bool isOnMirror(std::size_t data) const {
    if (sketch.imagesOf(target.id).empty()) return false;
    const SurfacePoint& point = grip.curve.data[data];
    const Result<SurfacePoint> image = detail::mirrored(sketch.model(), point);
    return image &&
           (position(sketch.mesh(), *image) - position(sketch.mesh(), point)).norm() < 1e-6;
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
  Result<Grip> grip = gripOf(sketch, *target, curve, stretch);
  if (!grip) return grip.error();
  if (handle >= grip->handles.size()) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("the stretch has {} handles; there is no handle {}",
                             grip->handles.size(), handle),
                 {Element::curve(curve)}};
  }
  if (grip->curve.closed && stretch.from == 0 && stretch.to == 1) openRing(*grip, handle);
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
    if (!(from == to)) moved.push_back({from, to, isDragged && !s.rail});
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
    std::erase_if(moved, [&](const detail::MovedNode& node) {
      return node.from == s.grip.curve.data[s.grip.handles[s.handle]];
    });
  }
  const Result<void> followed = detail::followNodes(sketch, s.target.id, curve, moved);
  if (!followed) return followed.error();
  sketch.store(s.target.id, curve);
  return sketch.document();
}

Result<Document> moveHandle(const Document& document, const std::string& curve,
                            const Stretch& stretch, std::size_t handle, const SurfacePoint& to) {
  Result<CurveDrag> drag = CurveDrag::begin(document, curve, stretch, handle);
  if (!drag) return drag.error();
  if (const Result<void> moved = drag->moveOnto(to); !moved) return moved.error();
  return drag->document();
}

Result<Document> insertControl(const Document& document, const std::string& curve, double at) {
  if (const Result<double> checked = detail::checkedFraction(at); !checked) return checked.error();
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  const double all = detail::arcsOf(sketch.mesh(), *work)[work->linkCount()];
  const std::size_t index = detail::insertData(sketch.mesh(), *work, at * all);
  work->isControl[index] = true;
  sketch.store(target->id, *work);
  return sketch.document();
}

Result<Document> removeControl(const Document& document, const std::string& curve, double at,
                               Length within) {
  if (const Result<double> checked = detail::checkedFraction(at); !checked) return checked.error();
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  const Mesh& mesh = sketch.mesh();
  const std::vector<double> arcs = detail::arcsOf(mesh, *work);
  const double all = arcs[work->linkCount()];
  std::optional<std::size_t> nearest;
  double least = within.mm();
  std::size_t controls = 0;
  for (std::size_t i = 0; i < work->data.size(); ++i) {
    if (!work->isControl[i]) continue;
    ++controls;
    double distance = std::abs(arcs[i] - at * all);
    if (work->closed) distance = std::min(distance, all - distance);
    if (distance <= least) {
      least = distance;
      nearest = i;
    }
  }
  const bool isEnd =
      nearest && !work->closed && (*nearest == 0 || *nearest + 1 == work->data.size());
  if (!nearest || isEnd || (work->closed && controls <= 3)) {
    return Error{ErrorCode::CurveInvalid,
                 !nearest ? fmt::format("curve \"{}\" has no control point within {:.1f} mm there",
                                        curve, within.mm())
                 : isEnd  ? fmt::format("curve \"{}\" needs its end; trim it instead", curve)
                          : fmt::format("curve \"{}\" is closed and needs 3 control points", curve),
                 {Element::curve(curve)}};
  }
  // Without the point, its place is that of the curve through the neighbouring controls.
  std::size_t index = *nearest;
  std::size_t turned = 0;
  if (work->closed) {
    turned = (index + work->data.size() / 2) % work->data.size();
    detail::rotate(*work, turned);
    index = (index + work->data.size() - turned) % work->data.size();
  }
  std::vector<std::size_t> around;
  for (std::size_t i = 0; i < work->data.size(); ++i) {
    const bool isEndOfRow = i == 0 || i + 1 == work->data.size();
    if (i != index && (work->isControl[i] || isEndOfRow)) around.push_back(i);
  }
  const auto after = std::upper_bound(around.begin(), around.end(), index);
  const auto before = after - 1;
  std::vector<Vector3d> row;
  std::size_t span = 0;
  for (auto it = before - std::min<std::ptrdiff_t>(2, before - around.begin());
       it != around.end() && it <= after + 2; ++it) {
    if (it == before) span = row.size();
    row.push_back(position(mesh, work->data[*it]));
  }
  const std::vector<Vector3d> fine = subdivide<3>(row, false);
  const std::vector<double> now = detail::arcsOf(mesh, *work);
  const double t = (now[index] - now[*before]) / (now[*after] - now[*before]);
  const auto cell = static_cast<double>(std::size_t{8} * span) + 8 * t;
  const auto low =
      static_cast<std::size_t>(std::floor(std::min(cell, static_cast<double>(fine.size() - 2))));
  const double u = cell - static_cast<double>(low);
  SurfaceTracker tracker(sketch.model().mesh, work->data[index]);
  const SurfacePoint to = tracker.moveTo((1 - u) * fine[low] + u * fine[low + 1]);
  work->isControl[index] = work->isCorner[index] = false;
  detail::Reshaper reshaper(*sketch.model().index, sketch.linker());
  const auto end = [&](std::size_t i) {
    const bool isOwn = !work->closed && (i == 0 || i + 1 == work->data.size());
    return isOwn ? StretchEnd::Place : StretchEnd::Tangent;
  };
  Result<detail::Reshaper::Reshaped> made =
      reshaper.reshape(*work, {{*before, std::nullopt}, {index, to}, {*after, std::nullopt}},
                       end(*before), end(*after));
  if (!made) return made.error();
  std::vector<detail::MovedNode> moved;
  for (std::size_t i = 0; i < work->data.size(); ++i) {
    const SurfacePoint& place = made->curve.data[made->newIndex[i]];
    if (!(place == work->data[i])) moved.push_back({work->data[i], place, false});
  }
  if (work->closed) {
    detail::rotate(made->curve, made->newIndex[(work->data.size() - turned) % work->data.size()]);
  }
  const Result<void> followed = detail::followNodes(sketch, target->id, made->curve, moved);
  if (!followed) return followed.error();
  sketch.store(target->id, made->curve);
  return sketch.document();
}

}  // namespace toile
