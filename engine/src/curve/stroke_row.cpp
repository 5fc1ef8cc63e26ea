// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/stroke_row.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile::detail {

using Eigen::Vector2d;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHookPressure = 0.1;  ///< of the median
/// Arms over which the direction at a corner is measured, in tolerances, and at the closer look.
constexpr double kArm = 4;
constexpr double kShortArm = 2;
/// A corner turns as much over short arms; an arc only half.
constexpr double kSharpness = 0.7;
constexpr double kCorner = 50 * kDegree;
constexpr double kCornerSlow = 38 * kDegree;  ///< where the pen was at half its speed or less
constexpr double kCornerFast = 65 * kDegree;  ///< where it was not slowed down
/// Ends nearer than this, in tolerances and in parts of the stroke, are meant to meet.
constexpr double kCloseTolerances = 3;
constexpr double kClosePart = 0.03;
constexpr double kEndPart = 0.15;  ///< of the stroke, in which its overlap is looked for

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::span<const StrokeSample> withoutHooks(std::span<const StrokeSample> stroke) {
  std::vector<double> pressures;
  for (const StrokeSample& s : stroke) pressures.push_back(s.pressure);
  const double least = kHookPressure * median(pressures);
  while (stroke.size() > 2 && stroke.front().pressure < least) stroke = stroke.subspan(1);
  while (stroke.size() > 2 && stroke.back().pressure < least) {
    stroke = stroke.first(stroke.size() - 1);
  }
  return stroke;
}

/// Direction of the least-squares line through points from `from` on, `count` of them.
Vector2d direction(const StrokeRow& row, std::ptrdiff_t from, std::ptrdiff_t count) {
  const auto n = static_cast<std::ptrdiff_t>(row.points.size());
  Vector2d mean = Vector2d::Zero(), moment = Vector2d::Zero();
  const double middle = 0.5 * static_cast<double>(count - 1);
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const Vector2d& p = row.points[static_cast<std::size_t>(((from + k) % n + n) % n)];
    mean += p;
    moment += (static_cast<double>(k) - middle) * p;
  }
  return moment;
}

double turnAt(const StrokeRow& row, std::ptrdiff_t i, std::ptrdiff_t arm) {
  const Vector2d before = direction(row, i - arm, arm + 1), after = direction(row, i, arm + 1);
  return std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
}

}  // namespace

StrokeRow makeStrokeRow(std::span<const StrokeSample> all, const StrokeOptions& options) {
  const std::span<const StrokeSample> stroke = withoutHooks(all);
  std::vector<Vector2d> places;
  std::vector<double> times;
  for (const StrokeSample& s : stroke) {
    if (!places.empty() && (s.place - places.back()).norm() < 1e-9) continue;
    places.push_back(s.place);
    times.push_back(s.time);
  }
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < places.size(); ++i) {
    arc.push_back(arc.back() + (places[i] - places[i - 1]).norm());
  }
  StrokeRow row;
  if (places.size() < 2) {
    row.points = places;
    return row;
  }

  // Closed: the overlap of both ends is cut off where they come nearest.
  std::size_t first = 0, last = places.size() - 1;
  if (options.closed.value_or(true)) {
    const double reach = std::max(kCloseTolerances * options.tolerance, kClosePart * arc.back());
    double nearest = options.closed ? std::numeric_limits<double>::infinity() : reach;
    const bool mayClose = options.closed || arc.back() > 8 * reach;
    for (std::size_t i = 0; mayClose && arc[i] <= kEndPart * arc.back(); ++i) {
      for (std::size_t j = places.size() - 1; arc[j] >= (1 - kEndPart) * arc.back() && j > i; --j) {
        const double distance = (places[i] - places[j]).norm();
        if (distance < nearest) {
          nearest = distance;
          first = i;
          last = j;
          row.closed = true;
        }
      }
    }
  }
  places.assign(places.begin() + static_cast<std::ptrdiff_t>(first),
                places.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  times.assign(times.begin() + static_cast<std::ptrdiff_t>(first),
               times.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  if (row.closed) {
    places.push_back(places.front());
    times.push_back(times.back());
  }
  arc.assign(1, 0.0);
  for (std::size_t i = 1; i < places.size(); ++i) {
    arc.push_back(arc.back() + (places[i] - places[i - 1]).norm());
  }

  const auto count = static_cast<std::size_t>(
      std::clamp(std::ceil(arc.back() / (0.5 * options.tolerance)), 8.0, 2000.0));
  row.step = arc.back() / static_cast<double>(count);
  std::vector<double> timeAt;
  std::size_t segment = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = row.step * static_cast<double>(i);
    while (segment + 2 < arc.size() && arc[segment + 1] < s) ++segment;
    const double span = arc[segment + 1] - arc[segment];
    const double t = span > 0 ? std::clamp((s - arc[segment]) / span, 0.0, 1.0) : 0.0;
    row.points.push_back((1 - t) * places[segment] + t * places[segment + 1]);
    timeAt.push_back((1 - t) * times[segment] + t * times[segment + 1]);
  }
  if (timeAt.back() > timeAt.front()) {
    std::vector<double> speeds;
    for (std::size_t i = 0; i <= count; ++i) {
      const std::size_t a = i > 1 ? i - 2 : 0, b = std::min(i + 2, count);
      speeds.push_back(row.step * static_cast<double>(b - a) /
                       std::max(1e-9, timeAt[b] - timeAt[a]));
    }
    const double usual = median(speeds);
    for (double& speed : speeds) speed /= usual;
    row.speed = std::move(speeds);
  }
  if (row.closed) {
    row.points.pop_back();
    if (!row.speed.empty()) row.speed.pop_back();
  }
  return row;
}

std::vector<std::size_t> findCorners(const StrokeRow& row, double tolerance) {
  const auto n = static_cast<std::ptrdiff_t>(row.points.size());
  const auto arm = std::max<std::ptrdiff_t>(3, std::lround(kArm * tolerance / row.step));
  const auto shortArm = std::max<std::ptrdiff_t>(2, std::lround(kShortArm * tolerance / row.step));
  std::vector<double> turns(row.points.size(), 0);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    // Nearer to an open end than the arms reach they get shorter, but not shorter than the closer
    // look.
    const std::ptrdiff_t reach = row.closed ? arm : std::min({arm, i, n - 1 - i});
    if (reach >= shortArm) turns[static_cast<std::size_t>(i)] = turnAt(row, i, reach);
  }
  std::vector<std::size_t> corners;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    double needed = kCorner;
    if (!row.speed.empty()) {
      if (row.speed[at] <= 0.5) needed = kCornerSlow;
      if (row.speed[at] >= 0.9) needed = kCornerFast;
    }
    if (turns[at] < needed) continue;
    bool isGreatest = true;
    for (std::ptrdiff_t k = -arm; k <= arm && isGreatest; ++k) {
      std::ptrdiff_t j = i + k;
      if (row.closed) j = (j % n + n) % n;
      if (j < 0 || j >= n || k == 0) continue;
      const double other = turns[static_cast<std::size_t>(j)];
      isGreatest = other < turns[at] || (other == turns[at] && j > i);
    }
    if (isGreatest && turnAt(row, i, shortArm) >= kSharpness * turns[at]) corners.push_back(at);
  }
  return corners;
}

}  // namespace toile::detail
