// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "fit/surface.h"
#include "fit/target.h"

namespace toile::fitting {

/// Rotation, one scale, shift.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& p) const {
    return scale * (rotation * p) + shift;
  }
  [[nodiscard]] Eigen::Vector3d undo(const Eigen::Vector3d& p) const {
    return rotation.transpose() * (p - shift) / scale;
  }
};

/// The one that brings `from` nearest to `to` in the weighted least squares sense.
/// @see Umeyama, "Least-Squares Estimation of Transformation Parameters Between Two Point
///   Patterns", IEEE PAMI 13(4), 1991.
[[nodiscard]] Similarity bestSimilarity(const std::vector<Eigen::Vector3d>& from,
                                        const std::vector<Eigen::Vector3d>& to,
                                        const std::vector<double>& weights);

/// The rotation nearest to a linear map.
[[nodiscard]] Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& linear);

struct Placement {
  Similarity similarity;  ///< template to scan
  double score = 0;       ///< 0 = lies on it, 1 = nothing is near; of the best placement
  double margin = 0;      ///< score of the second best, over this
  /// Score of the best placement of the template's mirror image; the same for a symmetric one.
  double mirrorScore = 0;
  bool scanIsInsideOut = false;  ///< its normals point against the template's
};

/// Places the template on the scan from any start: principal axes both ways round, then iterated
/// closest points from each, with scale.
/// @see Besl and McKay, "A Method for Registration of 3-D Shapes", IEEE PAMI 14(2), 1992.
[[nodiscard]] Placement place(const Shape& shape, const Target& target, bool isSymmetric);

/// By landmarks alone, of the template and of the scan.
[[nodiscard]] Placement placeByLandmarks(const Shape& shape, const Target& target,
                                         const std::vector<Eigen::Vector3d>& own,
                                         const std::vector<Eigen::Vector3d>& wanted);

}  // namespace toile::fitting
