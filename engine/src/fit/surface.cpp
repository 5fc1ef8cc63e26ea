// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/surface.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace toile::fitting {

Eigen::Vector3d faceCross(const std::vector<Eigen::Vector3d>& positions, const Triangle& triangle) {
  const Eigen::Vector3d& a = positions[triangle[0].index()];
  return (positions[triangle[1].index()] - a).cross(positions[triangle[2].index()] - a);
}

Shape makeShape(const std::vector<Triangle>& triangles, std::vector<Eigen::Vector3d> positions) {
  Shape shape;
  shape.positions = std::move(positions);
  shape.normals.assign(shape.positions.size(), Eigen::Vector3d::Zero());
  shape.area.assign(shape.positions.size(), 0.0);
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d cross = faceCross(shape.positions, t);
    const double area = cross.norm() / 2;
    shape.totalArea += area;
    for (const VertexId v : t) {
      shape.normals[v.index()] += cross;
      shape.area[v.index()] += area / 3;
    }
  }
  for (Eigen::Vector3d& n : shape.normals) n.stableNormalize();
  return shape;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace toile::fitting
