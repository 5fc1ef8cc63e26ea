// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "toile/mesh/surface_point.h"

namespace toile {

struct ClosestPoint {
  SurfacePoint point;
  Eigen::Vector3d position;
  double distance = 0;  ///< mm
};

struct RayHit {
  SurfacePoint point;
  Eigen::Vector3d position;
  double t = 0;              ///< position = origin + t * direction, t >= 0
  bool facesOrigin = false;  ///< the outside of the surface is seen
};

/// Spatial index of one mesh (a tree of boxes). Holds the mesh; queries are const and may run on
/// several threads. Exact to double rounding.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(std::shared_ptr<const Mesh> mesh);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  [[nodiscard]] const Mesh& mesh() const;
  [[nodiscard]] ClosestPoint closestPoint(const Eigen::Vector3d& to) const;
  /// All hits, nearest first; the direction need not be of unit length.
  [[nodiscard]] std::vector<RayHit> rayHits(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction) const;
  /// The first hit whose outside faces the origin.
  [[nodiscard]] std::optional<RayHit> firstVisibleHit(const Eigen::Vector3d& origin,
                                                      const Eigen::Vector3d& direction) const;
  /// The section with the plane normal . x = offset: closed paths, and open ones that end at the
  /// border; longest first. Exact through vertices and along edges lying in the plane.
  [[nodiscard]] std::vector<SurfacePath> planeSection(const Eigen::Vector3d& normal,
                                                      double offset) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace toile
