// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer/live_images.h"

#include <algorithm>

#include "model/mirror.h"
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
    const SurfacePoint& end =
        point == old.data.front() ? image.points.front() : image.points.back();
    return (position(mesh, end) - place).norm() < kOnImage ? point : end;
  }
  const PathFoot foot = nearestOnPath(mesh, image, place);
  if (foot.distance < kOnImage) return point;
  return pointAtFraction(mesh, image, std::clamp(foot.arc / length(mesh, image), 0.0, 1.0));
}

/// Leads a curve through another place instead of a data point, or also, where others still end at
/// the latter.
Result<void> leadThrough(Sketch& sketch, const std::string& id, const SurfacePoint& from,
                         const SurfacePoint& to, bool keepsFrom) {
  const CurveWay way = sketch.edit(id).way;
  Result<WorkCurve> work = sketch.load(id);
  if (!work) return work.error();
  const Mesh& mesh = sketch.mesh();
  const auto found = std::find(work->data.begin(), work->data.end(), from);
  if (found == work->data.end()) return {};
  auto at = static_cast<std::size_t>(found - work->data.begin());
  if (keepsFrom) {
    const PathFoot foot = nearestOnPath(mesh, pathOf(*work), position(mesh, to));
    at = insertData(mesh, *work, foot.arc);
    if (work->data[at] == from) return {};  // nearer than cutting tells apart
  }
  work->data[at] = to;
  for (SurfacePath& link : work->links) {
    const auto i = static_cast<std::size_t>(&link - work->links.data());
    if (!(link.points.front() == work->from(i)) || !(link.points.back() == work->to(i))) {
      link.points.clear();
    }
  }
  if (const Result<void> linked = linkAll(sketch.linker(), *work); !linked) {
    return linked.error().during("curve \"" + id + "\"");
  }
  sketch.store(id, *work);
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
    // Other images follow their originals, which meet as they do.
    std::vector<std::string> through;
    for (std::size_t c = 0; c < own.curves.size(); ++c) {
      if (c == index || originalOf[c]) continue;
      const auto& data = sketch.design().curves[c].dataPoints;
      if (std::find(data.begin(), data.end(), stored) != data.end()) {
        through.push_back(own.curves[c].id);
      }
    }
    if (through.empty()) continue;
    const SurfacePoint to = placeOnImage(sketch.mesh(), image->front().path, *old, point);
    if (to == point) continue;
    for (const std::string& other : through) {
      const Result<void> led = leadThrough(sketch, other, point, to, through.size() > 1);
      if (!led) return led;
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
