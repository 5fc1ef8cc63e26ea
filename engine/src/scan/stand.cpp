// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/stand.h"

#include <array>
#include <limits>
#include <optional>

#include "fit/segments.h"
#include "toile/body/body.h"

namespace toile::scanning {
namespace {

/// As good as this, other postures need not be tried.
constexpr double kClearScore = 0.3;
/// Of the height.
constexpr double kNear = 0.08;

}  // namespace

double Stand::height() const {
  return placement.similarity.scale * (body.mesh->boxMax().z() - body.mesh->boxMin().z());
}

bool Stand::isNear(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d own = placement.similarity.undo(p);
  const double far = kNear * height() / placement.similarity.scale;
  return body.index->closestPoint(own).distance < far;
}

std::string Stand::describe(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d own = placement.similarity.undo(p);
  fitting::Places places;
  for (const auto& [name, point] : body.landmarks) places[name] = position(*body.mesh, point);
  const std::vector<std::uint32_t> segment = fitting::segmentOfPoints({own}, places);
  const std::string side = nameOfDirection(placement.similarity.rotation.transpose() * normal);
  return segment.empty() ? side : fitting::bodySegments()[segment.front()].name + ", " + side;
}

Result<Stand> findStand(const fitting::Target& target, const Progress* progress) {
  std::optional<Stand> best;
  for (const Posture posture :
       {Posture::APose, Posture::ArmsRaised, Posture::KneeBent, Posture::Seated}) {
    if (isCancelled(progress)) return Error{ErrorCode::Cancelled, "cancelled", {}};
    BodyOptions options;
    options.masculine = 0.5;
    options.posture = posture;
    Result<ReferenceModel> body = makeBody(options);
    if (!body) return body.error();
    const fitting::Shape shape =
        fitting::makeShape(body->mesh->triangles(), body->mesh->positions());
    const fitting::Placement placement = fitting::place(shape, target, /*isSymmetric=*/true);
    if (!best || placement.score < best->placement.score) {
      best = Stand{*std::move(body), placement};
    }
    if (best->placement.score < kClearScore) break;
  }
  return *std::move(best);
}

std::string nameOfDirection(const Eigen::Vector3d& direction) {
  constexpr std::array<std::array<const char*, 2>, 3> kNames = {
      {{"right", "left"}, {"front", "back"}, {"below", "above"}}};
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return kNames[static_cast<std::size_t>(axis)][direction[axis] > 0 ? 1 : 0];
}

}  // namespace toile::scanning
