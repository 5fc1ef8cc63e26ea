// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer/border.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace toile::detail {

namespace {

constexpr double kFarFromBorder = 20;  ///< mm

bool isOnBorder(const Mesh& mesh, const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) return mesh.isBorder(*v);
  const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at);
  return on != nullptr && mesh.isBorder(on->edge);
}

}  // namespace

BorderKeeper::BorderKeeper(const Mesh& source, const ReferenceModel& target)
    : source_(source), target_(*target.mesh) {
  for (std::size_t e = 0; e < target_.edgeCount(); ++e) {
    if (target_.isBorder(EdgeId(e))) borderEdges_.emplace_back(e);
  }
}

SurfacePoint BorderKeeper::keep(const SurfacePoint& point, const SurfacePoint& image) {
  if (!isOnBorder(source_, point) || isOnBorder(target_, image)) return image;
  const Eigen::Vector3d place = position(target_, image);
  double least = std::numeric_limits<double>::infinity();
  SurfacePoint nearest = image;
  for (const EdgeId edge : borderEdges_) {
    const Eigen::Vector3d& a = target_.position(target_.tail(edge));
    const Eigen::Vector3d along = target_.position(target_.head(edge)) - a;
    const double t = std::clamp((place - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (place - a - t * along).norm();
    if (distance >= least) continue;
    least = distance;
    if (t <= 0 || t >= 1) {
      nearest = SurfacePoint{t <= 0 ? target_.tail(edge) : target_.head(edge)};
    } else {
      nearest = SurfacePoint{SurfacePoint::OnEdge{edge, t}};
    }
  }
  if (least > kFarFromBorder) {
    ++lost_;
    return image;
  }
  return nearest;
}

std::vector<Finding> BorderKeeper::findings() const {
  if (lost_ == 0) return {};
  return {{"curve-off-border",
           fmt::format("{} point{} on the border of the model came to lie inside the other, away "
                       "from any border",
                       lost_, lost_ == 1 ? "" : "s"),
           {}}};
}

}  // namespace toile::detail
