// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace toile::detail {

/// Weights of the point of a triangle nearest to p; exact zeros on its sides and corners. Works for
/// triangles without area.
[[nodiscard]] Eigen::Vector3d closestWeights(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                             const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// A ray prepared for many triangles.
///
/// The test is watertight: neighbours compute the same number, negated, for their common edge, so a
/// ray never slips between them, and a zero says that it meets the edge itself.
/// @see Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
class RayTriangleTest {
 public:
  struct Hit {
    double t = 0;
    Eigen::Vector3d weights;
    bool facesOrigin = false;
  };
  RayTriangleTest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
  /// Nothing behind the origin, and nothing for a triangle seen exactly edge on.
  [[nodiscard]] std::optional<Hit> meet(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c) const;

 private:
  [[nodiscard]] Eigen::Vector3d sheared(const Eigen::Vector3d& p) const;

  Eigen::Vector3d origin_;
  int x_ = 0;
  int y_ = 1;
  int z_ = 2;
  Eigen::Vector3d shear_;
};

}  // namespace toile::detail
