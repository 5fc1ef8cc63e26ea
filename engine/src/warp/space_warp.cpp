// SPDX-License-Identifier: GPL-3.0-or-later
#include "warp/space_warp.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toile::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

/// Spread of the points in their thinnest direction over that in the widest: less is a plane.
constexpr double kFlat = 1e-3;
/// How far the map may miss a place, against bending: in cubes of the mean distance of the points.
/// Noise of the map from body to body is not worth a dent.
constexpr double kStiffness = 1;

double cubed(double r) {
  return r * r * r;
}

}  // namespace

std::optional<SpaceWarp> SpaceWarp::through(const std::vector<Vector3d>& points,
                                            const std::vector<Vector3d>& places) {
  const auto count = static_cast<Index>(points.size());
  if (count < 4) return std::nullopt;
  SpaceWarp warp;
  MatrixXd from(3, count), to(3, count);
  for (Index i = 0; i < count; ++i) {
    from.col(i) = points[static_cast<std::size_t>(i)];
    to.col(i) = places[static_cast<std::size_t>(i)];
  }
  warp.middle_ = from.rowwise().mean();
  from.colwise() -= warp.middle_;
  const Eigen::JacobiSVD<MatrixXd> spread(from * from.transpose());
  if (spread.singularValues()[2] < kFlat * kFlat * spread.singularValues()[0]) return std::nullopt;
  warp.size_ = std::sqrt(spread.singularValues()[0] / static_cast<double>(count));
  warp.points_ = from / warp.size_;

  // The affine map alone first, so that what it explains leaves nothing to the rest.
  MatrixXd polynomial(count, 4);
  polynomial.col(0).setOnes();
  polynomial.rightCols(3) = warp.points_.transpose();
  const Eigen::Matrix4d normal = polynomial.transpose() * polynomial;
  const Eigen::Matrix<double, 4, 3> best =
      normal.ldlt().solve(polynomial.transpose() * to.transpose());
  const MatrixXd rest = to.transpose() - polynomial * best;

  double apart = 0;
  for (Index i = 0; i < count; ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Index j = 0; j < count; ++j) {
      if (i != j) {
        nearest = std::min(nearest, (warp.points_.col(i) - warp.points_.col(j)).squaredNorm());
      }
    }
    apart += std::sqrt(nearest) / static_cast<double>(count);
  }
  MatrixXd system = MatrixXd::Zero(count + 4, count + 4);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < i; ++j) {
      system(i, j) = cubed((warp.points_.col(i) - warp.points_.col(j)).norm());
      system(j, i) = system(i, j);
    }
    system(i, i) = kStiffness * cubed(apart);
  }
  system.topRightCorner(count, 4) = polynomial;
  system.bottomLeftCorner(4, count) = polynomial.transpose();
  MatrixXd right = MatrixXd::Zero(count + 4, 3);
  right.topRows(count) = rest;
  const MatrixXd solution = system.partialPivLu().solve(right);
  if (!solution.allFinite()) return std::nullopt;
  warp.weights_ = solution.topRows(count).transpose();
  const Eigen::Matrix<double, 4, 3> linear = best + solution.bottomRows(4);
  warp.affine_.linear() = linear.bottomRows(3).transpose() / warp.size_;
  warp.affine_.translation() = linear.row(0).transpose() - warp.affine_.linear() * warp.middle_;
  return warp;
}

Vector3d SpaceWarp::operator()(const Vector3d& p) const {
  const Vector3d q = (p - middle_) / size_;
  Vector3d sum = affine_ * p;
  for (Index i = 0; i < points_.cols(); ++i) {
    sum += cubed((points_.col(i) - q).norm()) * weights_.col(i);
  }
  return sum;
}

std::vector<std::size_t> farthestPoints(const std::vector<Vector3d>& points, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (points.empty()) return chosen;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  std::vector<double> distance(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    distance[i] = (points[i] - middle).squaredNorm();
  }
  std::size_t next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                              distance.begin());
  std::fill(distance.begin(), distance.end(), std::numeric_limits<double>::infinity());
  while (chosen.size() < count && distance[next] > 0) {
    chosen.push_back(next);
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      distance[i] = std::min(distance[i], (points[i] - points[next]).squaredNorm());
      if (distance[i] > distance[farthest]) farthest = i;
    }
    next = farthest;
  }
  return chosen;
}

}  // namespace toile::detail
