// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "toile/mesh/surface_point.h"

namespace toile {

/// Finds locally shortest paths on one mesh. Keeps its workspace between calls: one per thread.
///
/// A link starts as the shortest way along mesh edges; the strip of faces beside it is unfolded and
/// pulled tight, and led around the other side of each corner that has less than pi there, until
/// every corner has at least pi - 1e-9 on both sides (or runs along the border). A path never
/// leaves the surface; at a vertex of positive curvature it does not pass, through one of negative
/// curvature it may. Between points a few triangles apart it is the shortest path of all, as far as
/// a bounded search tells. The link from b to a is the reverse of that from a to b, bit for bit.
class GeodesicLinker {
 public:
  explicit GeodesicLinker(std::shared_ptr<const Mesh> mesh);
  ~GeodesicLinker();
  GeodesicLinker(GeodesicLinker&&) noexcept;
  GeodesicLinker& operator=(GeodesicLinker&&) noexcept;

  /// @return an open path from a to b (at least two points); CurveInvalid when a and b lie in
  ///   different components or are the same point.
  /// @par Cost  the search along edges takes the part of the mesh around both ends; straightening
  ///   is linear in the triangles crossed for each round of it, a few for short links, dozens for
  ///   far
  Result<SurfacePath> link(const SurfacePoint& a, const SurfacePoint& b);
  /// Links each point to the next (and the last to the first when closed) into one path; equal
  /// neighbours are joined. CurveInvalid also for fewer than 2 (closed: 3) different points.
  Result<SurfacePath> linkAll(std::span<const SurfacePoint> points, bool closed);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// Least angle, over both sides, by which the interior points of a path miss being locally
/// shortest: 0 when every corner has at least pi on each side. For checks and tests.
[[nodiscard]] double geodesicDefect(const Mesh& mesh, const SurfacePath& path);

}  // namespace toile
