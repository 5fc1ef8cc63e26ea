// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "toile/mesh/surface_point.h"

namespace toile::detail {

/// Closest points among what hangs together around a guide point, so that the answer does not lie
/// on another limb that happens to be near.
class LocalClosest {
 public:
  explicit LocalClosest(const Mesh& mesh) : mesh_(mesh), seen_(mesh.faceCount(), 0) {}

  /// Searches the connected part, around the guide, of the surface within the ball around it that
  /// must hold the closest point: twice as large as the distance from guide to place.
  SurfacePoint find(const Eigen::Vector3d& place, const SurfacePoint& guide);
  /// The same within a ball of the given radius around the guide.
  SurfacePoint find(const Eigen::Vector3d& place, const SurfacePoint& guide, double radius);

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> seen_;  ///< the call that looked at the face
  std::vector<FaceId> queue_;
  std::uint32_t call_ = 0;
};

}  // namespace toile::detail
