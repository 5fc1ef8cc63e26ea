// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/mirror_images.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace toile {
namespace {

using Eigen::Vector2d;

/// The polygon mirrored at x = 0, counter-clockwise again.
Points2 mirrored(const Points2& polygon) {
  Points2 out;
  out.reserve(polygon.size());
  for (auto p = polygon.rbegin(); p != polygon.rend(); ++p) out.emplace_back(-p->x(), p->y());
  return out;
}

Vector2d centroid(const Points2& polygon) {
  Vector2d sum = Vector2d::Zero();
  double area = 0;
  const Vector2d& origin = polygon.front();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vector2d a = polygon[i] - origin;
    const Vector2d b = polygon[i + 1] - origin;
    area += cross(a, b);
    sum += cross(a, b) * (a + b) / 3;
  }
  return area != 0 ? Vector2d(origin + sum / area) : origin;
}

double diameter(const Points2& polygon) {
  return boxOf(polygon).size().norm();
}

/// About so many points, evenly along the polygon.
Points2 sampled(const Points2& polygon, std::size_t count) {
  double whole = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    whole += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  const double step = whole / static_cast<double>(count);
  Points2 out;
  double next = 0;
  double at = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d d = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = d.norm();
    for (; next < at + length && out.size() < count; next += step)
      out.push_back(polygon[i] + ((next - at) / length) * d);
    at += length;
  }
  return out;
}

/// Could the second be the first's mirror image: as large, and where the mirror shows it?
bool isCandidate(const PlacedPiece& a, const PlacedPiece& b) {
  const double size = diameter(a.cut);
  const Vector2d centre = centroid(a.cut);
  return a.side == b.side && std::abs(diameter(b.cut) - size) < 0.05 * size &&
         std::abs(signedArea(a.cut) - signedArea(b.cut)) < 1e-3 * std::abs(signedArea(a.cut)) &&
         (Vector2d(-centre.x(), centre.y()) - centroid(b.cut)).norm() < 0.1 * size;
}

/// Sets a piece across the axis upright, so that it mirrors itself.
bool makeSymmetric(PlacedPiece& piece) {
  const Alignment self = align(mirrored(piece.cut), piece.cut);
  if (self.distance > kSameLineMm) return false;
  // It mirrors itself at a line that leans by half the turn and runs through its centroid.
  Placement upright{-0.5 * self.motion.angle, Vector2d::Zero()};
  upright.offset = -upright.applyToDirection(centroid(piece.cut));
  upright.offset.y() += centroid(piece.cut).y();
  piece.move(upright);
  return true;
}

}  // namespace

Alignment align(const Points2& moving, const Points2& still) {
  constexpr std::size_t kSamples = 160;
  constexpr int kMostSteps = 12;
  const EdgeGrid grid({still});
  const Points2 samples = sampled(moving, kSamples);
  const Vector2d pivot = centroid(moving);
  const double radius = std::max(diameter(moving), 1e-9);
  Alignment result;
  for (int step = 0; step < kMostSteps; ++step) {
    // Unknowns: turn about the pivot (times the radius) and shift; row: normal . step = -distance.
    Eigen::Matrix3d matrix = 1e-12 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const Vector2d centre = result.motion.apply(pivot);
    double distance = 0;
    for (const Vector2d& sample : samples) {
      const Vector2d p = result.motion.apply(sample);
      const EdgeGrid::Nearest nearest = grid.nearest(p);
      distance = std::max(distance, nearest.distance);
      const Vector2d edge = still[(nearest.edge + 1) % still.size()] - still[nearest.edge];
      if (edge.norm() <= 0) continue;
      const Vector2d normal = Vector2d(edge.y(), -edge.x()).normalized();
      const Eigen::Vector3d row(cross(p - centre, normal) / radius, normal.x(), normal.y());
      matrix += row * row.transpose();
      right -= normal.dot(p - nearest.point) * row;
    }
    result.distance = distance;
    const Eigen::Vector3d d = matrix.ldlt().solve(right);
    if (!d.allFinite() || d.norm() < 1e-12 * radius) break;
    Placement more{d[0] / radius, Vector2d::Zero()};
    more.offset = centre + Vector2d(d[1], d[2]) - more.applyToDirection(centre);
    result.motion = composed(more, result.motion);
  }
  return result;
}

std::vector<std::optional<std::size_t>> makeMirrored(std::vector<PlacedPiece>& placed) {
  constexpr double kMiddle = 0.02;  // of the size: a piece that near to the axis lies across it
  std::vector<std::optional<std::size_t>> mirror(placed.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (mirror[i] || placed[i].byHand) continue;
    if (std::abs(centroid(placed[i].cut).x()) < kMiddle * diameter(placed[i].cut)) {
      if (makeSymmetric(placed[i])) mirror[i] = i;
      continue;
    }
    const Points2 image = mirrored(placed[i].cut);
    for (std::size_t j = i + 1; j < placed.size() && !mirror[i]; ++j) {
      if (mirror[j] || placed[j].byHand || !isCandidate(placed[i], placed[j])) continue;
      const Alignment found = align(image, placed[j].cut);
      if (found.distance > kSameLineMm) continue;
      placed[j].move(inverse(found.motion));
      placed[j].grownBy = mirrored(placed[i].grownBy);
      mirror[i] = j;
      mirror[j] = i;
    }
  }
  return mirror;
}

}  // namespace toile
