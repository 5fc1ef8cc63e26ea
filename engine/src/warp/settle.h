// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <array>
#include <optional>
#include <vector>

#include "toile/core/progress.h"
#include "toile/mesh/surface_index.h"

namespace toile::detail {

/// A point of the product with what is asked of its distance to the body, mm.
struct EasePoint {
  std::array<std::uint32_t, 3> corners{};
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  double ease = 0;

  template <class PerVertex>
  [[nodiscard]] Eigen::Vector3d at(const PerVertex& values) const {
    return weights[0] * values[corners[0]] + weights[1] * values[corners[1]] +
           weights[2] * values[corners[2]];
  }
};

/// What the product has to become around the body.
struct Wishes {
  std::vector<double> ease, easeWeight;  ///< per vertex: distance, and how much it counts, 0..1
  std::vector<EasePoint> exact;          ///< distances that must be met
  std::vector<EasePoint> least;          ///< distances that must not be fallen short of
  std::vector<std::vector<VertexId>> rigid;
};

/// Distances over which the product bends when it is pulled, mm.
[[nodiscard]] double bendingLength(const Mesh& product);

/// Moves a product that stands around a body roughly, so that the wishes are met: of all ways the
/// one whose displacement bends least.
/// @param product  as it was around the other body; what rigid parts keep
/// @param start    positions to begin with, smooth images of the product's
/// @return nullopt when cancelled
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> settle(
    const Mesh& product, const std::vector<Eigen::Vector3d>& start, const SurfaceIndex& body,
    const Wishes& wishes, Progress* progress);

/// Cotangent Laplacian, positive semidefinite, and the vertices' areas; slivers are tamed.
struct Laplacian {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd area;
};
[[nodiscard]] Laplacian makeLaplacian(const Mesh& connectivity,
                                      const std::vector<Eigen::Vector3d>& positions);

}  // namespace toile::detail
