// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include "toile/unfold/unfold.h"
#include "unfold/energy_term.h"

namespace toile::unfolding {

/// A triangle's map to the plane, row by row.
struct PlaneMap {
  double xx = 0, xy = 0, yx = 0, yy = 0;
  [[nodiscard]] double determinant() const { return xx * yy - xy * yx; }
};
[[nodiscard]] PlaneMap mapOf(const RestTriangle& triangle, const Plane& q);
/// Larger one first; the smaller one is negative for a flipped triangle.
[[nodiscard]] std::array<double, 2> singularValues(const PlaneMap& map);

/// A sum over the triangles of functions of their maps, infinite for flipped ones.
class TriangleEnergy : public EnergyTerm {
 public:
  TriangleEnergy(const Problem& problem, const BlockPattern& pattern);

  [[nodiscard]] double distanceToBorder(const Plane& q, const Plane& d) const override;

 protected:
  [[nodiscard]] const std::vector<RestTriangle>& triangles() const { return problem_->triangles; }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& grain() const { return problem_->grain; }
  /// Adds what a triangle's derivatives by the numbers of its map, row by row, are by its vertices.
  void add(std::size_t triangle, const Eigen::Matrix2d& byMap, const Eigen::Matrix4d& hessianByMap,
           Eigen::VectorXd& gradient, BlockMatrix& hessian) const;

 private:
  const Problem* problem_;
  std::vector<std::array<BlockPattern::Place, 3>> places_;  ///< of the sides 01, 12, 20
};

/// The strain of the cloth that the options speak of.
[[nodiscard]] std::unique_ptr<TriangleEnergy> makeStrain(const Problem& problem,
                                                         const BlockPattern& pattern,
                                                         const UnfoldOptions& options);

}  // namespace toile::unfolding
