// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "toile/mesh/surface_point.h"

namespace toile {

/// Finds locally shortest paths on one mesh. Keeps its workspace between calls: one per thread.
///
/// Short links (a few triangles) go by an unfolded strip and a funnel; far ones start from a
/// shortest edge path and are straightened until every corner is at least pi - 1e-9 on both sides
/// (or runs along the border). A path never leaves the surface; at a vertex of positive curvature
/// it does not pass, through one of negative curvature it may.
class GeodesicLinker {
 public:
  explicit GeodesicLinker(std::shared_ptr<const Mesh> mesh);
  ~GeodesicLinker();
  GeodesicLinker(GeodesicLinker&&) noexcept;
  GeodesicLinker& operator=(GeodesicLinker&&) noexcept;

  /// @return an open path from a to b (at least two points); CurveInvalid when a and b lie in
  ///   different components or are the same point.
  /// @par Cost  about linear in the triangles crossed; far links O(n log n) for the first path
  Result<SurfacePath> link(const SurfacePoint& a, const SurfacePoint& b);
  /// Links each point to the next (and the last to the first when closed) into one path; equal
  /// neighbours are joined. `dataPointIndex` of the result's points is not kept.
  Result<SurfacePath> linkAll(std::span<const SurfacePoint> points, bool closed);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// Least angle, over both sides, by which the interior points of a path miss being locally
/// shortest: 0 when every corner has at least pi on each side. For checks and tests.
[[nodiscard]] double geodesicDefect(const Mesh& mesh, const SurfacePath& path);

}  // namespace toile
