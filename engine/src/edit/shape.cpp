// SPDX-License-Identifier: GPL-3.0-or-later
// Handles and control points.
#include "toile/edit/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "edit/grip.h"
#include "edit/nodes.h"
#include "toile/curve/subdivision.h"
#include "toile/curve/tracking.h"

namespace toile {

using detail::Grip;
using detail::Sketch;
using detail::StretchEnd;
using detail::WorkCurve;
using Eigen::Vector3d;

Result<std::vector<Handle>> handlesOf(const Document& document, const std::string& curve,
                                      const Stretch& stretch) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<Grip> grip = detail::gripOf(sketch, *target, curve, stretch);
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
