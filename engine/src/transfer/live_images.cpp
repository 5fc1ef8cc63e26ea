// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer/live_images.h"

#include <algorithm>

#include "design/mirror.h"
#include "toile/curve/crossing.h"

namespace toile::detail {

namespace {

/// Nearer than this a point lies on the image already, mm.
constexpr double kOnImage = 1e-6;

/// Where on the image a point of the curve that it takes the place of belongs.
SurfacePoint placeOnImage(const Mesh& mesh, const SurfacePath& image, const WorkCurve& old,
                          const SurfacePoint& point) {
  const Eigen::Vector3d place = position(mesh, point);
  if (!old.closed && (point == old.data.front() || point == old.data.back())) {
    const SurfacePoint& end = point == old.data.front() ? image.points.front() : image.points.back();
    return (position(mesh, end) - place).norm() < kOnImage ? point : end;
  }
  const PathFoot foot = nearestOnPath(mesh, image, place);
  if (foot.distance < kOnImage) return point;
  return pointAtFraction(mesh, image, std::clamp(foot.arc / length(mesh, image), 0.0, 1.0));
}

/// Moves a data point of a curve to another place.
Result<void> moveData(Sketch& sketch, const std::string& id, const SurfacePoint& from,
                      const SurfacePoint& to) {
  const CurveWay way = sketch.edit(id).way;
  Result<WorkCurve> work = sketch.load(id);
  if (!work) return work.error();
  for (SurfacePoint& point : work->data) {
    if (point == from) point = to;
  }
  std::vector<SurfacePoint> points = work->data;
  Result<WorkCurve> moved = makeWorkCurve(sketch.linker(), sketch.mesh(), points, work->closed);
  if (!moved) return moved.error().during("curve \"" + id + "\"");
  if (moved->data.size() == work->data.size()) {
    moved->isControl = work->isControl;
    moved->isCorner = work->isCorner;
  }
  sketch.store(id, *moved);
  if (!std::holds_alternative<SmoothWay>(way)) sketch.edit(id).way = way;
  return {};
}

Result<void> reviveImage(Sketch& sketch, const Design& own, std::size_t index,
                         const std::vector<std::optional<std::size_t>>& originalOf) {
  const StylingCurve& ownCurve = own.curves[index];
  const Result<WorkCurve> old = sketch.load(ownCurve.id);
  if (!old) return old.error();
  StylingCurve& curve = sketch.edit(ownCurve.id);
  curve.mirrorOf = ownCurve.mirrorOf;
  curve.way = ownCurve.way;
  const auto& symmetry = sketch.model().symmetry;
  if (!symmetry || symmetry->partner.empty()) return {};

  curve.dataPoints.clear();
  const std::span<const std::string> id(&ownCurve.id, 1);
  const Result<std::vector<PlacedCurve>> image =
      placeCurves(sketch.design(), sketch.model(), id, sketch.linker());
  if (!image) return image.error();
  for (const SurfacePoint& point : old->data) {
    const ModelPoint stored = toModelPoint(sketch.mesh(), point);
    std::optional<SurfacePoint> to;
    for (std::size_t c = 0; c < own.curves.size(); ++c) {
      // Other images follow their originals, which meet as they do.
      if (c == index || originalOf[c]) continue;
      const auto& data = sketch.design().curves[c].dataPoints;
      if (std::find(data.begin(), data.end(), stored) == data.end()) continue;
      if (!to) to = placeOnImage(sketch.mesh(), image->front().path, *old, point);
      if (*to == point) break;
      const Result<void> moved = moveData(sketch, own.curves[c].id, point, *to);
      if (!moved) return moved;
    }
  }
  return {};
}

}  // namespace

Result<void> reviveImages(Sketch& sketch, const Design& own,
                          const std::vector<std::optional<std::size_t>>& originalOf) {
  // An image of an image comes after it.
  std::vector<std::pair<std::size_t, std::size_t>> byDepth;
  for (std::size_t i = 0; i < originalOf.size(); ++i) {
    std::size_t depth = 0;
    for (auto at = originalOf[i]; at; at = originalOf[*at]) ++depth;
    if (depth > 0) byDepth.emplace_back(depth, i);
  }
  std::sort(byDepth.begin(), byDepth.end());
  for (const auto& [depth, i] : byDepth) {
    if (const Result<void> done = reviveImage(sketch, own, i, originalOf); !done) return done;
  }
  return {};
}

}  // namespace toile::detail
