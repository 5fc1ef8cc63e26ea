// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/smooth_points.h"

#include <optional>

namespace toile::detail {

namespace {

/// A step on the surface that is longer than the step in space by this factor has left the limb.
constexpr double kJumpRatio = 3;

}  // namespace

Result<std::vector<SurfacePoint>> smoothPoints(const SurfaceIndex& index, GeodesicLinker& linker,
                                               const std::vector<SurfacePoint>& controls,
                                               bool closed, SubdivisionRule rule,
                                               std::span<const std::size_t> corners) {
  const Mesh& mesh = index.mesh();
  std::vector<Eigen::Vector3d> places;
  for (const SurfacePoint& control : controls) places.push_back(position(mesh, control));
  const std::vector<Eigen::Vector3d> fine = subdivideWithCorners<3>(places, closed, corners, rule);

  constexpr std::size_t steps = std::size_t{1} << kSubdivisionRounds;
  const std::size_t spans = controls.size() - (closed ? 0 : 1);
  std::optional<LocalClosest> local;
  std::vector<SurfacePoint> data;
  for (std::size_t span = 0; span < spans; ++span) {
    const SurfacePoint& from = controls[span];
    const SurfacePoint& to = controls[(span + 1) % controls.size()];
    std::optional<SurfacePath> guide;
    data.push_back(from);
    for (std::size_t k = 1; k < steps; ++k) {
      const Eigen::Vector3d& place = fine[span * steps + k];
      SurfacePoint point = index.closestPoint(place).point;
      const SurfacePoint& previous = data.back();
      if (point == previous) continue;
      const Result<SurfacePath> step = linker.link(previous, point);
      const double allowed = kJumpRatio * (place - fine[span * steps + k - 1]).norm();
      if (!step || length(mesh, *step) > allowed) {
        if (!guide) {
          Result<SurfacePath> way = linker.link(from, to);
          if (!way) return way.error();
          guide = *std::move(way);
        }
        if (!local) local.emplace(mesh);
        const double fraction = static_cast<double>(k) / static_cast<double>(steps);
        point = local->find(place, pointAtFraction(mesh, *guide, fraction));
      }
      data.push_back(point);
    }
  }
  if (!closed) data.push_back(controls.back());
  return data;
}

}  // namespace toile::detail
