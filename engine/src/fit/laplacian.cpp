// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/laplacian.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace toile::fitting {

Eigen::SparseMatrix<double> cotangentLaplacian(const std::vector<Triangle>& triangles,
                                               const std::vector<Eigen::Vector3d>& positions) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k].index();
      const std::uint32_t b = t[(k + 1) % 3].index();
      const Eigen::Vector3d& tip = positions[t[(k + 2) % 3].index()];
      const Eigen::Vector3d u = positions[a] - tip;
      const Eigen::Vector3d v = positions[b] - tip;
      const double cotangent = u.dot(v) / std::max(u.cross(v).norm(), 1e-12);
      const double weight = std::clamp(0.5 * cotangent, 1e-3, 1e3);
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(std::max(a, b), std::min(a, b), -weight);
    }
  }
  const auto size = static_cast<Eigen::Index>(positions.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace toile::fitting
