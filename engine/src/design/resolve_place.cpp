// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>

#include "design/section_loop.h"
#include "toile/curve/geodesic.h"
#include "toile/design/design.h"

namespace toile {

namespace {

Result<SurfacePoint> atFraction(const Mesh& mesh, const SurfacePath& path, double fraction) {
  if (!(fraction >= 0 && fraction <= 1)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("a fraction of a curve must be from 0 to 1, not {}", fraction),
                 {}};
  }
  return pointAtFraction(mesh, path, fraction);
}

struct Resolver {
  const ReferenceModel& model;
  const std::vector<PlacedCurve>& placed;

  Result<SurfacePoint> operator()(const ModelPoint& point) const {
    return toSurfacePoint(*model.mesh, point);
  }
  Result<SurfacePoint> operator()(const AtLandmark& at) const {
    const auto found = model.landmarks.find(at.name);
    if (found != model.landmarks.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& entry : model.landmarks) known.push_back(entry.first);
    return detail::nameNotFound("landmark", at.name, known);
  }
  Result<SurfacePoint> operator()(const OnModelCurve& on) const {
    const auto found = model.curves.find(on.name);
    if (found != model.curves.end()) return atFraction(*model.mesh, found->second, on.fraction);
    std::vector<std::string> known;
    for (const auto& entry : model.curves) known.push_back(entry.first);
    return detail::nameNotFound("model curve", on.name, known);
  }
  Result<SurfacePoint> operator()(const OnStylingCurve& on) const {
    std::vector<std::string> known;
    for (const PlacedCurve& curve : placed) {
      if (curve.id == on.id) return atFraction(*model.mesh, curve.path, on.fraction);
      known.push_back(curve.id);
    }
    return detail::nameNotFound("curve", on.id, known);
  }
  Result<SurfacePoint> operator()(const OnSection& on) const {
    const Result<SurfacePath> loop = detail::sectionLoop(on.plane, model);
    if (!loop) return loop.error();
    return detail::pointOnLoop(*model.mesh, *loop, on.plane.normal, on.direction);
  }
  Result<SurfacePoint> operator()(const NearPosition& near) const {
    if (!near.position.allFinite()) {
      return Error{ErrorCode::InvalidArgument, "a position must be three finite numbers", {}};
    }
    return model.index->closestPoint(near.position).point;
  }
  Result<SurfacePoint> operator()(const BetweenPlaces& between) const {
    const Result<SurfacePoint> from = std::visit(*this, between.ends[0]);
    if (!from) return from.error();
    const Result<SurfacePoint> to = std::visit(*this, between.ends[1]);
    if (!to) return to.error();
    if (*from == *to) return *from;
    const Result<SurfacePath> way = GeodesicLinker(model.mesh).link(*from, *to);
    if (!way) return way.error();
    return atFraction(*model.mesh, *way, between.fraction);
  }
};

}  // namespace

Result<SurfacePoint> resolvePlace(const Place& place, const ReferenceModel& model,
                                  const std::vector<PlacedCurve>& placed) {
  return std::visit(Resolver{model, placed}, place);
}

}  // namespace toile
