// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/displacement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "toile/core/assert.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

constexpr double kUneven = 3;

/// Slopes of the cubic spline: tridiagonal.
std::vector<Vector3d> splineSlopes(const std::vector<double>& h, const std::vector<Vector3d>& d,
                                   StretchEnd first, StretchEnd last) {
  const std::size_t n = h.size() + 1;
  std::vector<double> below(n, 0), middle(n, 1), above(n, 0);
  std::vector<Vector3d> right(n, Vector3d::Zero());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    below[i] = h[i];
    middle[i] = 2 * (h[i - 1] + h[i]);
    above[i] = h[i - 1];
    right[i] = 3 * (h[i] * d[i - 1] + h[i - 1] * d[i]);
  }
  if (first == StretchEnd::Place) {
    middle[0] = 2;
    above[0] = 1;
    right[0] = 3 * d.front();
  }
  if (last == StretchEnd::Place) {
    middle[n - 1] = 2;
    below[n - 1] = 1;
    right[n - 1] = 3 * d.back();
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / middle[i - 1];
    middle[i] -= factor * above[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= middle[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - above[i] * right[i + 1]) / middle[i];
  return right;
}

/// Slopes that keep every component monotone between the places (harmonic means).
std::vector<Vector3d> limitedSlopes(const std::vector<double>& h, const std::vector<Vector3d>& d,
                                    StretchEnd first, StretchEnd last) {
  const std::size_t n = h.size() + 1;
  std::vector<Vector3d> slopes(n, Vector3d::Zero());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double a = d[i - 1][k], b = d[i][k];
      if (a * b <= 0) continue;
      const double wa = 2 * h[i] + h[i - 1], wb = h[i] + 2 * h[i - 1];
      slopes[i][k] = (wa + wb) / (wa / a + wb / b);
    }
  }
  if (first == StretchEnd::Place) slopes.front() = d.front();
  if (last == StretchEnd::Place) slopes.back() = d.back();
  return slopes;
}

}  // namespace

Displacement::Displacement(std::vector<double> arcs, std::vector<Vector3d> values, StretchEnd first,
                           StretchEnd last)
    : arcs_(std::move(arcs)), values_(std::move(values)) {
  TOILE_ASSERT(arcs_.size() == values_.size() && arcs_.size() >= 2);
  std::vector<double> h;
  std::vector<Vector3d> d;
  bool isUneven = false;
  for (std::size_t i = 0; i + 1 < arcs_.size(); ++i) {
    h.push_back(std::max(1e-9, arcs_[i + 1] - arcs_[i]));
    d.push_back((values_[i + 1] - values_[i]) / h.back());
    if (i > 0) isUneven = isUneven || h[i] > kUneven * h[i - 1] || h[i - 1] > kUneven * h[i];
  }
  slopes_ = isUneven ? limitedSlopes(h, d, first, last) : splineSlopes(h, d, first, last);
}

Vector3d Displacement::at(double arc) const {
  const auto above = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, arc);
  const auto i = static_cast<std::size_t>(above - arcs_.begin()) - 1;
  const double h = std::max(1e-9, arcs_[i + 1] - arcs_[i]);
  const double t = std::clamp((arc - arcs_[i]) / h, 0.0, 1.0);
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * values_[i] + (t3 - 2 * t2 + t) * h * slopes_[i] +
         (3 * t2 - 2 * t3) * values_[i + 1] + (t3 - t2) * h * slopes_[i + 1];
}

}  // namespace toile::detail
