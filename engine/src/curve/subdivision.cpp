// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "toile/core/assert.h"

namespace toile {

namespace {

constexpr double kUnevenSpans = 3;  // neighbouring spans that differ by more are uneven

template <int Dimension>
using Point = Eigen::Matrix<double, Dimension, 1>;
template <int Dimension>
using Points = std::vector<Point<Dimension>>;

// Sums below are ordered so that a curve and its reverse give the same numbers bit for bit.

/// The middle of the span between p1 and p2 with equal knots.
template <int Dimension>
Point<Dimension> uniformMiddle(const Point<Dimension>& p0, const Point<Dimension>& p1,
                               const Point<Dimension>& p2, const Point<Dimension>& p3) {
  return (9.0 * (p1 + p2) - (p0 + p3)) / 16.0;
}

/// The cubic through four points at the middle parameter of the span p1, p2; d = knot spans.
template <int Dimension>
Point<Dimension> cubicMiddle(const std::array<Point<Dimension>, 4>& p,
                             const std::array<double, 3>& d) {
  if (!(d[0] > 0 && d[1] > 0 && d[2] > 0)) return 0.5 * (p[1] + p[2]);
  const double half = 0.5 * d[1];
  const double before = d[0] + half, after = d[2] + half, all = (d[0] + d[2]) + d[1];
  const double w0 = -half * half * after / (d[0] * (d[0] + d[1]) * all);
  const double w3 = -half * half * before / (d[2] * (d[2] + d[1]) * all);
  const double w1 = before * after / (2 * (d[0] * (d[2] + d[1])));
  const double w2 = before * after / (2 * (d[2] * (d[0] + d[1])));
  return (w0 * p[0] + w3 * p[3]) + (w1 * p[1] + w2 * p[2]);
}

/// The middle of the first span from the polynomial through the first 3 or 4 points.
template <int Dimension>
Point<Dimension> oneSidedMiddle(std::span<const Point<Dimension>> p, std::span<const double> d) {
  std::array<double, 4> knot{-0.5 * d[0], 0.5 * d[0], 0, 0};
  for (std::size_t i = 2; i < p.size(); ++i) {
    if (!(d[i - 1] > 0)) return 0.5 * (p[0] + p[1]);
    knot[i] = knot[i - 1] + d[i - 1];
  }
  Point<Dimension> middle = Point<Dimension>::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < p.size(); ++j) {
      if (j != i) weight *= knot[j] / (knot[j] - knot[i]);
    }
    middle += weight * p[i];
  }
  return middle;
}

/// Spans between neighbours; of a closed row also from the last to the first.
template <int Dimension>
std::vector<double> spansOf(std::span<const Point<Dimension>> points, bool closed) {
  std::vector<double> spans;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i) {
    spans.push_back((points[(i + 1) % points.size()] - points[i]).norm());
  }
  return spans;
}

bool isUneven(const std::vector<double>& spans, bool closed) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < spans.size(); ++i) {
    const double a = spans[i], b = spans[(i + 1) % spans.size()];
    if (a > kUnevenSpans * b || b > kUnevenSpans * a) return true;
  }
  return false;
}

template <int Dimension>
Points<Dimension> uniformMiddles(const Points<Dimension>& p, bool closed) {
  const std::size_t n = p.size();
  Points<Dimension> middles;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Point<Dimension>& p1 = p[i];
    const Point<Dimension>& p2 = p[(i + 1) % n];
    const bool isFirst = !closed && i == 0, isLast = !closed && i + 2 == n;
    const Point<Dimension> p0 = isFirst ? Point<Dimension>(2 * p1 - p2) : p[(i + n - 1) % n];
    const Point<Dimension> p3 = isLast ? Point<Dimension>(2 * p2 - p1) : p[(i + 2) % n];
    middles.push_back(uniformMiddle<Dimension>(p0, p1, p2, p3));
  }
  return middles;
}

template <int Dimension>
Points<Dimension> centripetalMiddles(const Points<Dimension>& p, bool closed) {
  const std::size_t n = p.size();
  std::vector<double> d = spansOf<Dimension>(p, closed);
  for (double& span : d) span = std::sqrt(span);
  if (n == 2) return {0.5 * (p[0] + p[1])};

  const std::size_t spans = d.size();
  Points<Dimension> middles(spans);
  for (std::size_t i = 0; i < spans; ++i) {
    if (!closed && (i == 0 || i + 1 == spans)) continue;
    middles[i] = cubicMiddle<Dimension>({p[(i + n - 1) % n], p[i], p[(i + 1) % n], p[(i + 2) % n]},
                                        {d[(i + spans - 1) % spans], d[i], d[(i + 1) % spans]});
  }
  if (!closed) {
    const std::size_t used = std::min<std::size_t>(n, 4);
    middles.front() = oneSidedMiddle<Dimension>(std::span(p).first(used), d);
    const Points<Dimension> ending(p.rbegin(), p.rbegin() + static_cast<std::ptrdiff_t>(used));
    const std::vector<double> endingSpans(d.rbegin(), d.rend());
    middles.back() = oneSidedMiddle<Dimension>(ending, endingSpans);
  }
  return middles;
}

}  // namespace

template <int Dimension>
std::vector<Eigen::Matrix<double, Dimension, 1>> subdivide(
    std::span<const Eigen::Matrix<double, Dimension, 1>> points, bool closed, SubdivisionRule rule,
    int rounds) {
  TOILE_ASSERT(points.size() >= (closed ? 3U : 2U));
  if (rule == SubdivisionRule::Auto) {
    rule = isUneven(spansOf<Dimension>(points, closed), closed) ? SubdivisionRule::Centripetal
                                                                : SubdivisionRule::Uniform;
  }
  Points<Dimension> coarse(points.begin(), points.end());
  for (int round = 0; round < rounds; ++round) {
    const Points<Dimension> middles = rule == SubdivisionRule::Uniform
                                          ? uniformMiddles<Dimension>(coarse, closed)
                                          : centripetalMiddles<Dimension>(coarse, closed);
    Points<Dimension> fine;
    fine.reserve(coarse.size() + middles.size());
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      fine.push_back(coarse[i]);
      if (i < middles.size()) fine.push_back(middles[i]);
    }
    coarse = std::move(fine);
  }
  return coarse;
}

template <int Dimension>
std::vector<Eigen::Matrix<double, Dimension, 1>> subdivideWithCorners(
    std::span<const Eigen::Matrix<double, Dimension, 1>> points, bool closed,
    std::span<const std::size_t> corners, SubdivisionRule rule, int rounds) {
  const std::size_t n = points.size();
  std::vector<std::size_t> breaks;
  for (const std::size_t corner : corners) {
    const bool isInside = closed ? corner < n : corner > 0 && corner + 1 < n;
    if (isInside && (breaks.empty() || breaks.back() < corner)) breaks.push_back(corner);
  }
  if (breaks.empty()) return subdivide<Dimension>(points, closed, rule, rounds);

  // A closed row is taken from its first corner on, once around.
  const std::size_t first = closed ? breaks.front() : 0;
  const std::size_t last = closed ? n : n - 1;
  std::vector<std::size_t> ends;  // of the parts, counted from `first`
  for (const std::size_t at : breaks) {
    if (at > first) ends.push_back(at - first);
  }
  ends.push_back(last);
  Points<Dimension> fine;
  std::size_t from = 0;
  for (const std::size_t to : ends) {
    Points<Dimension> part;
    for (std::size_t i = from; i <= to; ++i) part.push_back(points[(first + i) % n]);
    const Points<Dimension> refined = subdivide<Dimension>(part, false, rule, rounds);
    if (!fine.empty()) fine.pop_back();
    fine.insert(fine.end(), refined.begin(), refined.end());
    from = to;
  }
  if (closed) {
    fine.pop_back();
    const std::size_t back = first << static_cast<unsigned>(rounds);
    std::rotate(fine.begin(), fine.end() - static_cast<std::ptrdiff_t>(back), fine.end());
  }
  return fine;
}

template std::vector<Eigen::Vector2d> subdivide<2>(std::span<const Eigen::Vector2d>, bool,
                                                   SubdivisionRule, int);
template std::vector<Eigen::Vector3d> subdivide<3>(std::span<const Eigen::Vector3d>, bool,
                                                   SubdivisionRule, int);

template std::vector<Eigen::Vector2d> subdivideWithCorners<2>(std::span<const Eigen::Vector2d>,
                                                              bool, std::span<const std::size_t>,
                                                              SubdivisionRule, int);
template std::vector<Eigen::Vector3d> subdivideWithCorners<3>(std::span<const Eigen::Vector3d>,
                                                              bool, std::span<const std::size_t>,
                                                              SubdivisionRule, int);

}  // namespace toile
