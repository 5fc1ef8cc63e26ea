// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "toile/curve/stroke.h"

namespace toile::detail {

/// A stroke at even steps, the trembling of single samples taken out.
struct StrokeRow {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> speed;  ///< relative to the median; empty = not known
  double step = 0;            ///< mm
  bool closed = false;        ///< then the last point is not the first again
};

/// Cuts off hooks, resamples, finds whether the stroke is closed.
[[nodiscard]] StrokeRow makeStrokeRow(std::span<const StrokeSample> stroke,
                                      const StrokeOptions& options);
/// Indices of the points where the stroke has a corner; never an end of an open one.
[[nodiscard]] std::vector<std::size_t> findCorners(const StrokeRow& row, double tolerance);

}  // namespace toile::detail
