// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/wrist.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toile::fitting {
namespace {

// Of the forearm's length.
constexpr double kFrom = 0.5;
constexpr double kTo = 1.5;
constexpr double kStep = 1.0 / 80;
constexpr double kHalfSlice = 1.0 / 40;
constexpr double kRadius = 0.4;

constexpr double kGrown = 1.2;       // of the least girth: here the hand begins
constexpr double kAsThin = 1.03;     // of the least girth: the wrist is in the middle of such
constexpr std::size_t kFewest = 10;  // points that make a slice

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double hullLength(const std::vector<Kernel::Point_2>& points) {
  std::vector<Kernel::Point_2> hull;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  double length = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    length += std::sqrt(CGAL::squared_distance(hull[i], hull[(i + 1) % hull.size()]));
  }
  return length;
}

}  // namespace

std::optional<double> wristAlong(const Forearm& forearm,
                                 const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d axis = forearm.axis();
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  struct OnAxis {
    double along;
    Kernel::Point_2 across;
  };
  std::vector<OnAxis> near;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d from = p - forearm.elbow;
    const Eigen::Vector2d across(from.dot(u), from.dot(v));
    if (across.norm() > kRadius * forearm.length()) continue;
    near.push_back({from.dot(axis) / forearm.length(), {across.x(), across.y()}});
  }
  struct Slice {
    double along, girth;
  };
  std::vector<Slice> slices;
  double least = std::numeric_limits<double>::infinity();
  for (double at = kFrom; at < kTo; at += kStep) {
    std::vector<Kernel::Point_2> slice;
    for (const OnAxis& p : near) {
      if (std::abs(p.along - at) <= kHalfSlice) slice.push_back(p.across);
    }
    if (slice.size() < kFewest) continue;
    slices.push_back({at, hullLength(slice)});
    least = std::min(least, slices.back().girth);
    if (slices.back().girth < kGrown * least) continue;
    double sum = 0, count = 0;
    for (const Slice& one : slices) {
      if (one.girth > kAsThin * least) continue;
      sum += one.along;
      ++count;
    }
    return sum / count * forearm.length();
  }
  return std::nullopt;
}

}  // namespace toile::fitting
