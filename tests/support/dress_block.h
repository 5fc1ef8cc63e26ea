// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "toile/model/reference_model.h"

namespace toile::test {

/// A dress block: an open tube from below the hip to the bust that stands away from the body's
/// convex sections by the ease. Rings of vertices from below, each counter-clockwise from the left.
inline Mesh dressBlock(const ReferenceModel& body, double ease, int columns = 72, int rows = 40) {
  const auto levelOf = [&](const std::string& curve) {
    double sum = 0;
    const SurfacePath& path = body.curves.at(curve);
    for (const SurfacePoint& point : path.points) sum += position(*body.mesh, point).z();
    return sum / static_cast<double>(path.points.size());
  };
  const double low = levelOf("hip_girth") - 20, high = levelOf("bust_girth") + 10;
  constexpr int kDirections = 360;
  std::vector<Eigen::Vector3d> positions;
  for (int row = 0; row <= rows; ++row) {
    const double z = low + (high - low) * row / rows;
    std::vector<Eigen::Vector3d> torso;
    for (const SurfacePath& path : body.index->planeSection(Eigen::Vector3d::UnitZ(), z)) {
      if (!path.closed) continue;
      for (const SurfacePoint& point : path.points) torso.push_back(position(*body.mesh, point));
      break;  // the longest
    }
    double front = std::numeric_limits<double>::infinity(), back = -front;
    for (const Eigen::Vector3d& p : torso) {
      front = std::min(front, p.y());
      back = std::max(back, p.y());
    }
    const Eigen::Vector3d middle(0, (front + back) / 2, z);
    std::vector<double> support(kDirections, 0);
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0);
      for (const Eigen::Vector3d& p : torso) {
        support[static_cast<std::size_t>(d)] =
            std::max(support[static_cast<std::size_t>(d)], normal.dot(p - middle) + ease);
      }
    }
    for (int column = 0; column < columns; ++column) {
      const double angle = 2 * std::numbers::pi * column / columns;
      double radius = std::numeric_limits<double>::infinity();
      for (int d = 0; d < kDirections; ++d) {
        const double along = std::cos(angle - 2 * std::numbers::pi * d / kDirections);
        if (along > 0.1) radius = std::min(radius, support[static_cast<std::size_t>(d)] / along);
      }
      positions.emplace_back(middle +
                             radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    }
  }
  std::vector<Triangle> triangles;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto at = [&](int c, int r) {
        return VertexId(static_cast<std::size_t>(r * columns + c % columns));
      };
      const VertexId a = at(column, row), b = at(column + 1, row);
      const VertexId c = at(column + 1, row + 1), d = at(column, row + 1);
      // Diagonals mirror each other in x = 0 and in the plane of the widest places.
      if ((4 * column / columns) % 2 == 0) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      }
    }
  }
  return makeMesh(std::move(positions), std::move(triangles)).value();
}

}  // namespace toile::test
