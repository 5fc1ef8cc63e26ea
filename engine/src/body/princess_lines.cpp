// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/princess_lines.h"

#include <vector>

#include "body/chains.h"
#include "body/subdivision.h"
#include "model/mirror.h"
#include "toile/core/assert.h"
#include "toile/curve/geodesic.h"
#include "toile/curve/subdivision.h"

namespace toile::body {
namespace {

/// A smooth line near the given vertices of the net, on the surface.
SurfacePath smoothLine(const ReferenceModel& model, const std::vector<std::size_t>& through) {
  std::vector<Eigen::Vector3d> controls;
  for (const std::size_t v : through) controls.push_back(model.mesh->position(VertexId(v)));
  const std::vector<Eigen::Vector3d> row =
      subdivide<3>(controls, false, SubdivisionRule::Centripetal);
  std::vector<SurfacePoint> points;
  for (const Eigen::Vector3d& place : row) points.push_back(model.index->closestPoint(place).point);
  // The ends are landmarks' places, to the bit.
  points.front() = {VertexId(through.front())};
  points.back() = {VertexId(through.back())};
  GeodesicLinker linker(model.mesh);
  Result<SurfacePath> path = linker.linkAll(points, false);
  TOILE_ASSERT(path.hasValue());
  return *path;
}

}  // namespace

void addPrincessLines(ReferenceModel& model) {
  const ControlNet& net = controlNet();
  const std::size_t shoulder = net.torso(kMidShoulderRow, kSideColumn);
  const auto at = [&](std::size_t row, std::size_t column) { return net.torso(row, column); };
  const SurfacePath front =
      smoothLine(model, {shoulder, at(kHighChestRow, 3), at(kBustRow, kBustColumn),
                         at(kUnderbustRow, 2), at(kWaistRow, 2), at(kHipRow, 3)});
  const SurfacePath back =
      smoothLine(model, {shoulder, at(kHighChestRow, 8), at(kUnderbustRow, 8), at(kWaistRow, 8),
                         at(kHighHipRow, 8), at(kHipRow, kBackColumn - 1)});
  const VertexData<VertexId>& partner = model.symmetry->partner;
  model.curves["princess_front_l"] = front;
  model.curves["princess_front_r"] = detail::mirrored(*model.mesh, partner, front);
  model.curves["princess_back_l"] = back;
  model.curves["princess_back_r"] = detail::mirrored(*model.mesh, partner, back);
}

}  // namespace toile::body
