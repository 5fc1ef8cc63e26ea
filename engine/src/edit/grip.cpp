// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/grip.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile::detail {

using Eigen::Vector3d;

namespace {

/// The end of a stretch goes to the next data point outwards, unless that is farther than this part
/// of the stretch; then one is made.
constexpr double kSnapPart = 0.25;

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
    if (const Result<double> checked = checkedFraction(f); !checked) return checked.error();
  }
  if (stretch.from == stretch.to || (!curve.closed && stretch.to < stretch.from)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("a stretch runs from one fraction to a larger one, not from {} to {}",
                             stretch.from, stretch.to),
                 {}};
  }
  Grip grip;
  const bool isWhole = stretch.from == 0 && stretch.to == 1;
  const double all = arcsOf(mesh, curve)[curve.linkCount()];
  double from = stretch.from * all, to = stretch.to * all;
  if (curve.closed && to < from) to += all;
  const double size = to - from;
  // Outwards to a data point that is there, or a new one.
  const auto dataAt = [&](double arc, bool outwardIsBack) {
    const double on = curve.closed ? arc - all * std::floor(arc / all) : arc;
    const std::vector<double> arcs = arcsOf(mesh, curve);
    const std::size_t n = curve.data.size(), count = curve.linkCount();
    const auto above =
        std::upper_bound(arcs.begin() + 1, arcs.begin() + static_cast<std::ptrdiff_t>(count),
                         on + (outwardIsBack ? kSameDataPoint : -kSameDataPoint));
    const auto link = static_cast<std::size_t>(above - arcs.begin()) - 1;
    const std::size_t outer = outwardIsBack ? link : link + 1;
    if (std::abs(arcs[outer] - on) <= kSnapPart * size) return outer % n;
    return insertData(mesh, curve, on);
  };
  if (isWhole) {
    grip.first = 0;
    grip.last = curve.data.size() - 1;
  } else if (!curve.closed) {
    // Inserting moves later indices: the later end first.
    grip.last = dataAt(to, false);
    const std::size_t between = curve.data.size();
    grip.first = dataAt(from, true);
    grip.last += curve.data.size() - between;
  } else {
    const SurfacePoint lastPoint = curve.data[dataAt(to, false)];
    const std::size_t first = dataAt(from, true);
    rotate(curve, first);
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
    std::vector<double> arcs = arcsOf(mesh, curve);
    const double begin = arcs[grip.first];
    const double span = (isRing ? arcs[curve.linkCount()] : arcs[grip.last]) - begin;
    const std::vector<std::size_t> none;
    for (int k = 1; k <= count; ++k) {
      const std::size_t size0 = curve.data.size();
      const double arc = begin + span * k / (count + (isRing ? 0 : 1));
      if (isRing && k == count) continue;  // the start of the ring is its last handle
      // An even sample takes a data point that is there, if it lies near.
      arcs = arcsOf(mesh, curve);
      const auto next = std::lower_bound(
          arcs.begin(), arcs.begin() + static_cast<std::ptrdiff_t>(curve.linkCount()), arc);
      auto at = static_cast<std::size_t>(next - arcs.begin());
      if (at > 0 && arc - arcs[at - 1] < arcs[at] - arc) --at;
      if (std::abs(arcs[at] - arc) > 0.1 * span / count || at <= grip.first || at >= grip.last) {
        at = insertData(mesh, curve, arc);
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

}  // namespace

void openRing(Grip& grip, std::size_t& handle) {
  WorkCurve& curve = grip.curve;
  const std::size_t n = curve.data.size();
  const std::size_t held = grip.handles[handle];
  const std::size_t start = grip.handles[(handle + grip.handles.size() / 2) % grip.handles.size()];
  rotate(curve, start);
  grip.turned = (grip.turned + start) % n;
  for (std::size_t& at : grip.handles) at = (at + n - start) % n;
  std::sort(grip.handles.begin(), grip.handles.end());
  const std::size_t now = (held + n - start) % n;
  grip.first = 0;
  grip.last = n - 1;
  grip.handles.erase(std::remove(grip.handles.begin(), grip.handles.end(), std::size_t{0}),
                     grip.handles.end());
  handle = static_cast<std::size_t>(std::find(grip.handles.begin(), grip.handles.end(), now) -
                                    grip.handles.begin());
}

Result<Grip> gripOf(Sketch& sketch, const Sketch::Target& target, const std::string& curve,
                    const Stretch& stretch) {
  Result<WorkCurve> work = sketch.load(target.id);
  if (!work) return work.error();
  Result<Grip> grip = take(sketch.mesh(), *std::move(work), stretch);
  if (!grip) return grip.error().during("curve \"" + curve + "\"");
  return grip;
}

}  // namespace toile::detail
