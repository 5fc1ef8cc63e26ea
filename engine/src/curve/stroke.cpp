// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/stroke.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "curve/stroke_row.h"
#include "toile/curve/subdivision.h"

namespace toile {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;

constexpr std::size_t kMaxSpans = 96;  ///< of one part between corners
constexpr std::size_t kFine = std::size_t{1} << kSubdivisionRounds;

/// How much each point of the refined row depends on each control: columns are refined unit rows.
MatrixXd refinedBasis(std::size_t controls, bool closed) {
  MatrixXd basis;
  for (std::size_t c = 0; c < controls; ++c) {
    std::vector<Vector2d> row(controls, Vector2d::Zero());
    row[c].x() = 1;
    const std::vector<Vector2d> fine =
        subdivide<2>(row, closed, SubdivisionRule::Uniform, kSubdivisionRounds);
    if (c == 0) {
      basis.resize(static_cast<Eigen::Index>(fine.size()), static_cast<Eigen::Index>(controls));
    }
    for (std::size_t i = 0; i < fine.size(); ++i) {
      basis(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = fine[i].x();
    }
  }
  return basis;
}

/// Control points at even parameters whose curve fits the points best; the ends of an open part may
/// be held.
std::vector<Vector2d> fitControls(const std::vector<Vector2d>& points, std::size_t spans,
                                  bool closed, bool holdFirst, bool holdLast) {
  const std::size_t controls = closed ? spans : spans + 1;
  const MatrixXd basis = refinedBasis(controls, closed);
  const std::size_t m = points.size();
  MatrixXd rows(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(controls));
  MatrixXd right(static_cast<Eigen::Index>(m), 2);
  const auto fineCount = static_cast<double>(spans * kFine);
  for (std::size_t i = 0; i < m; ++i) {
    const double u = fineCount * static_cast<double>(i) / static_cast<double>(closed ? m : m - 1);
    const auto cell = static_cast<std::size_t>(std::clamp(std::floor(u), 0.0, fineCount - 1));
    const double t = u - static_cast<double>(cell);
    const auto a = static_cast<Eigen::Index>(cell);
    const Eigen::Index b = closed ? (a + 1) % basis.rows() : a + 1;
    rows.row(static_cast<Eigen::Index>(i)) = (1 - t) * basis.row(a) + t * basis.row(b);
    right.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  }
  const Eigen::Index last = rows.cols() - 1;
  const auto hold = [&](Eigen::Index column, const Vector2d& value) {
    right -= rows.col(column) * value.transpose();
    rows.col(column).setZero();
  };
  if (holdFirst) hold(0, points.front());
  if (holdLast) hold(last, points.back());
  MatrixXd normal = rows.transpose() * rows;
  // Held columns, and what hardly any point sees, get a diagonal of their own.
  normal.diagonal().array() += 1e-9 * static_cast<double>(m) / static_cast<double>(controls);
  const MatrixXd solved = normal.ldlt().solve(rows.transpose() * right);
  std::vector<Vector2d> out;
  for (Eigen::Index c = 0; c <= last; ++c) out.emplace_back(solved.row(c).transpose());
  if (holdFirst) out.front() = points.front();
  if (holdLast) out.back() = points.back();
  return out;
}

/// Greatest distance of the points from the refined curve, both walked from their starts.
double deviation(const std::vector<Vector2d>& points, const std::vector<Vector2d>& controls,
                 bool closed, double enough) {
  std::vector<Vector2d> fine = subdivide<2>(controls, closed);
  if (closed) fine.push_back(fine.front());
  const auto distanceTo = [&](const Vector2d& p, std::size_t segment) {
    const Vector2d d = fine[segment + 1] - fine[segment];
    const double square = d.squaredNorm();
    const double t = square > 0 ? std::clamp((p - fine[segment]).dot(d) / square, 0.0, 1.0) : 0.0;
    return (fine[segment] + t * d - p).norm();
  };
  const std::size_t segments = fine.size() - 1;
  double greatest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Parameters agree about: the nearest segment lies within a span or two.
    const auto guess =
        static_cast<std::size_t>(static_cast<double>(segments) * static_cast<double>(i) /
                                 static_cast<double>(closed ? points.size() : points.size() - 1));
    const std::size_t window = 2 * kFine + segments / 16;
    const std::size_t from = guess > window ? guess - window : 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t s = from; s < std::min(segments, guess + window + 1); ++s) {
      nearest = std::min(nearest, distanceTo(points[i], s));
    }
    greatest = std::max(greatest, nearest);
    if (greatest > enough) return greatest;
  }
  return greatest;
}

/// Leaves out controls without which the curve stays within the tolerance, the straightest first.
void thinOut(std::vector<Vector2d>& controls, const std::vector<Vector2d>& points, bool closed,
             double tolerance) {
  const std::size_t fewest = closed ? 4 : 2;
  std::vector<std::size_t> order;
  const auto importance = [&](std::size_t i) {
    const std::size_t n = controls.size();
    const Vector2d &a = controls[(i + n - 1) % n], &b = controls[(i + 1) % n];
    return (controls[i] - 0.5 * (a + b)).norm();
  };
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < controls.size(); ++i) {
    order.push_back(i);
  }
  std::vector<double> weight(controls.size(), 0);
  for (const std::size_t i : order) weight[i] = importance(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weight[a] < weight[b]; });
  std::vector<bool> isKept(controls.size(), true);
  std::size_t kept = controls.size();
  const auto remaining = [&] {
    std::vector<Vector2d> out;
    for (std::size_t i = 0; i < controls.size(); ++i) {
      if (isKept[i]) out.push_back(controls[i]);
    }
    return out;
  };
  for (const std::size_t i : order) {
    if (kept <= fewest) break;
    isKept[i] = false;
    if (deviation(points, remaining(), closed, tolerance) > tolerance) {
      isKept[i] = true;
    } else {
      --kept;
    }
  }
  controls = remaining();
}

/// One part between corners.
std::vector<Vector2d> fitPart(const std::vector<Vector2d>& points, bool closed, bool holdFirst,
                              bool holdLast, double tolerance) {
  std::vector<Vector2d> controls;
  const std::size_t most = std::clamp<std::size_t>(points.size() / 3, 1, kMaxSpans);
  for (std::size_t spans = closed ? 4 : 1; spans <= std::max<std::size_t>(most, closed ? 4 : 1);
       spans += std::max<std::size_t>(1, spans / 4)) {
    controls = fitControls(points, spans, closed, holdFirst, holdLast);
    if (deviation(points, controls, closed, tolerance) <= tolerance) break;
  }
  thinOut(controls, points, closed, tolerance);
  return controls;
}

}  // namespace

Result<FittedStroke> fitStroke(std::span<const StrokeSample> stroke, const StrokeOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    return Error{
        ErrorCode::InvalidArgument,
        fmt::format("the tolerance of a stroke must be positive, not {} mm", options.tolerance),
        {}};
  }
  if (stroke.size() > kMaxStrokeSamples) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("a stroke of {} samples is too long; at most {}", stroke.size(),
                             kMaxStrokeSamples),
                 {}};
  }
  for (const StrokeSample& sample : stroke) {
    if (!sample.place.allFinite() || !std::isfinite(sample.time) ||
        !std::isfinite(sample.pressure)) {
      return Error{ErrorCode::InvalidArgument, "a sample of the stroke is no finite number", {}};
    }
  }
  double extent = 0;
  for (const StrokeSample& sample : stroke) {
    extent = std::max(extent, (sample.place - stroke.front().place).norm());
  }
  if (stroke.size() < 2 || extent <= options.tolerance) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("the stroke is shorter than the {:.2g} mm that count as trembling; "
                             "draw on, or come nearer with the view",
                             options.tolerance),
                 {}};
  }
  const detail::StrokeRow row = detail::makeStrokeRow(stroke, options);
  const std::vector<std::size_t> corners = detail::findCorners(row, options.tolerance);
  const std::size_t n = row.points.size();
  FittedStroke fitted;
  fitted.closed = row.closed;

  // Parts from corner to corner, each with both its ends; a closed stroke begins at a corner.
  std::vector<std::size_t> ends;
  if (!row.closed) ends.push_back(0);
  ends.insert(ends.end(), corners.begin(), corners.end());
  if (row.closed && !corners.empty()) ends.push_back(corners.front() + n);
  if (!row.closed) ends.push_back(n - 1);
  if (ends.empty()) {
    fitted.controls = fitPart(row.points, true, false, false, options.tolerance);
    fitted.deviation =
        deviation(row.points, fitted.controls, true, std::numeric_limits<double>::infinity());
    return fitted;
  }
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
    std::vector<Vector2d> points;
    for (std::size_t i = ends[e]; i <= ends[e + 1]; ++i) points.push_back(row.points[i % n]);
    const bool startsAtCorner = row.closed || e > 0;
    const bool endsAtCorner = row.closed || e + 2 < ends.size();
    const std::vector<Vector2d> part =
        fitPart(points, false, startsAtCorner, endsAtCorner, options.tolerance);
    fitted.deviation = std::max(
        fitted.deviation, deviation(points, part, false, std::numeric_limits<double>::infinity()));
    if (startsAtCorner) fitted.corners.push_back(fitted.controls.size() - (e > 0 ? 1 : 0));
    fitted.controls.insert(fitted.controls.end(), part.begin() + (e > 0 ? 1 : 0), part.end());
  }
  if (row.closed) fitted.controls.pop_back();
  return fitted;
}

}  // namespace toile
