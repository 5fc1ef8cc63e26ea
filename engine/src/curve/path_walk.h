// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/mesh/surface_point.h"

namespace toile::detail {

/// Places along a path, asked for in ascending order: one walk, where pointAtFraction() would begin
/// anew for each.
class PathWalk {
 public:
  PathWalk(const Mesh& mesh, const SurfacePath& path);
  /// @param arc mm from the start, not less than the last one asked for. Beyond the length: the
  /// end, or
  ///   the next round of a closed path.
  [[nodiscard]] SurfacePoint at(double arc);

 private:
  [[nodiscard]] double segmentLength(std::size_t segment) const;

  const Mesh& mesh_;
  const SurfacePath& path_;
  std::size_t segment_ = 0;
  double before_ = 0;  ///< mm from the start to the segment
  double span_ = 0;    ///< mm, of the segment
};

}  // namespace toile::detail
