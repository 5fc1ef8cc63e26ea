// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangulate_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toile::detail {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double twiceArea(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a;
  const Eigen::Vector2d v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

/// The polygon in the plane across its Newell normal; empty if it has no area.
Points projected(std::span<const Eigen::Vector3d> polygon) {
  const Eigen::Vector3d origin = polygon.front();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    normal += (polygon[i] - origin).cross(polygon[(i + 1) % polygon.size()] - origin);
  }
  const double length = normal.norm();
  if (!(length > 0) || !std::isfinite(length)) return {};
  normal /= length;
  const Eigen::Vector3d x = normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  Points points;
  points.reserve(polygon.size());
  for (const Eigen::Vector3d& p : polygon)
    points.emplace_back((p - origin).dot(x), (p - origin).dot(y));
  return points;
}

bool isStrictlyConvex(const Points& points) {
  const std::size_t n = points.size();
  double turning = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& a = points[i];
    const Eigen::Vector2d& b = points[(i + 1) % n];
    const Eigen::Vector2d& c = points[(i + 2) % n];
    const double cross = twiceArea(a, b, c);
    if (cross <= 0) return false;
    turning += std::atan2(cross, (b - a).dot(c - b));
  }
  return turning < 7.0;  // once around: 2 pi; a star polygon turns twice or more
}

/// Ears of the shrinking polygon, a doubly linked ring of its corners.
class EarCutter {
 public:
  explicit EarCutter(Points points) : points_(std::move(points)) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      previous_.push_back(i == 0 ? n - 1 : i - 1);
      next_.push_back(i == n - 1 ? 0 : i + 1);
      ring_.push_back(i);
    }
    quality_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) quality_[i] = earQuality(i);
  }

  PolygonTriangles cut() {
    PolygonTriangles result;
    while (ring_.size() > 3) {
      const auto best = std::max_element(
          ring_.begin(), ring_.end(),
          [&](std::uint32_t a, std::uint32_t b) { return quality_[a] < quality_[b]; });
      const std::uint32_t ear = *best;
      if (quality_[ear] <= 0) result.isSimple = false;
      result.corners.push_back({previous_[ear], ear, next_[ear]});
      const std::uint32_t before = previous_[ear];
      const std::uint32_t after = next_[ear];
      next_[before] = after;
      previous_[after] = before;
      ring_.erase(best);
      quality_[before] = earQuality(before);
      quality_[after] = earQuality(after);
    }
    const std::uint32_t last = ring_.front();
    if (!(twiceArea(points_[previous_[last]], points_[last], points_[next_[last]]) > 0)) {
      result.isSimple = false;
    }
    result.corners.push_back({previous_[last], last, next_[last]});
    return result;
  }

 private:
  /// The least angle's sine-like measure of the ear's triangle; 0 or less if it is none.
  double earQuality(std::uint32_t i) const {
    const Eigen::Vector2d& a = points_[previous_[i]];
    const Eigen::Vector2d& b = points_[i];
    const Eigen::Vector2d& c = points_[next_[i]];
    const double area = twiceArea(a, b, c);
    if (!(area > 0)) return -std::numeric_limits<double>::infinity();
    for (std::uint32_t k = next_[next_[i]]; k != previous_[i]; k = next_[k]) {
      const Eigen::Vector2d& p = points_[k];
      // A keyhole polygon passes the same place twice.
      if (p == a || p == b || p == c) continue;
      if (twiceArea(a, b, p) >= 0 && twiceArea(b, c, p) >= 0 && twiceArea(c, a, p) >= 0) {
        return -1;
      }
    }
    const double ab = (b - a).squaredNorm();
    const double bc = (c - b).squaredNorm();
    const double ca = (a - c).squaredNorm();
    const double longest = std::max({ab, bc, ca});
    const double middle = ab + bc + ca - longest - std::min({ab, bc, ca});
    // area = longest * middle * sin(least angle), as lengths.
    return area / std::sqrt(longest * middle);
  }

  Points points_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> ring_;  // what is left, ascending
  std::vector<double> quality_;
};

}  // namespace

PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> polygon) {
  const auto n = static_cast<std::uint32_t>(polygon.size());
  if (n < 3) return {{}, false};
  if (n == 3) return {{{0, 1, 2}}, true};
  Points points = projected(polygon);
  if (points.empty() || isStrictlyConvex(points)) {
    PolygonTriangles fan{{}, !points.empty()};
    for (std::uint32_t i = 1; i + 1 < n; ++i) fan.corners.push_back({0, i, i + 1});
    return fan;
  }
  return EarCutter(std::move(points)).cut();
}

}  // namespace toile::detail
