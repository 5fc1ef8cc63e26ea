// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace toile::detail {

/// A smooth map of space to itself that carries given points to given places: affine, and a sum of
/// r^3 about the points (triharmonic: of all such maps the one that bends least). Places that an
/// affine map explains are met by it alone.
class SpaceWarp {
 public:
  /// @return nullopt where the points do not span space
  static std::optional<SpaceWarp> through(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<Eigen::Vector3d>& places);
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;

 private:
  SpaceWarp() = default;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double size_ = 1;  ///< mm; points are (p - middle) / size
  Eigen::Matrix<double, 3, Eigen::Dynamic> points_;
  Eigen::Matrix<double, 3, Eigen::Dynamic> weights_;      ///< mm
  Eigen::Affine3d affine_ = Eigen::Affine3d::Identity();  ///< of p itself, to mm
};

/// Numbers of up to `count` of the points, each as far from those before as can be: an even
/// choice. The first is the one farthest from the middle.
[[nodiscard]] std::vector<std::size_t> farthestPoints(const std::vector<Eigen::Vector3d>& points,
                                                      std::size_t count);

}  // namespace toile::detail
