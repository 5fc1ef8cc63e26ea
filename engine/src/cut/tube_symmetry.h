// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::cutting {

/// A closed row of vertices: an open end of a tube.
using TubeEnd = std::vector<VertexId>;

/// The plane in which a tube is nearly its own mirror image: n . x = offset.
struct TubeSymmetry {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;
  double tolerance = 0;              ///< mm: what counts as the same place
  std::vector<std::size_t> imageOf;  ///< per end: the end on the other side, or itself
  [[nodiscard]] double height(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
  [[nodiscard]] Eigen::Vector3d image(const Eigen::Vector3d& p) const {
    return p - 2 * height(p) * normal;
  }
  /// Vertices of an end that runs through the plane, one for each time that it does.
  [[nodiscard]] std::vector<VertexId> middleOf(const Mesh& mesh, const TubeEnd& end) const;
};

/// Tries the planes through the middle of the surface that are upright and across the model's axes,
/// then those of the surface's own axes.
/// @param tolerance greatest distance from the image, as a share of the root of the area
/// @return only a plane that one end at least runs through
/// @par Cost  one search for the closest point per vertex and plane
[[nodiscard]] std::optional<TubeSymmetry> findTubeSymmetry(const std::shared_ptr<const Mesh>& mesh,
                                                           const std::vector<TubeEnd>& ends,
                                                           double tolerance);

}  // namespace toile::cutting
