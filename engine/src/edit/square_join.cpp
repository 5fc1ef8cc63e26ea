// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/square_join.h"

#include <algorithm>

#include "edit/middle_line.h"
#include "edit/nodes.h"

namespace toile::detail {

namespace {

/// Sine of the angle below which a link is square.
constexpr double kSquare = 1e-6;
/// A first link longer than this part of the curve is parted: at a third, so that a round line
/// turns by as much at the new data point as at the next one; at this part of the curve at most.
constexpr double kLongLink = 0.02;

/// Where the first link would end if it were so long and square.
std::optional<SurfacePoint> squareEnd(const Sketch& sketch, const WorkCurve& curve, double reach) {
  const Eigen::Vector3d towards = position(sketch.mesh(), curve.links.front().points[1]);
  return stepSquare(sketch.model(), curve.data.front(), towards, reach);
}

}  // namespace

bool beginsSquare(const Sketch& sketch, const WorkCurve& curve) {
  if (curve.closed || !isOnMiddle(sketch.model(), curve.data.front())) return false;
  const Mesh& mesh = sketch.mesh();
  const double reach = length(mesh, curve.links.front());
  const auto square = squareEnd(sketch, curve, reach);
  return square && (position(mesh, *square) - position(mesh, curve.data[1])).norm() <
                       kSquare * reach + kSameDataPoint;
}

void beginSquare(Sketch& sketch, const std::string& id, WorkCurve& curve) {
  if (curve.closed || !isOnMiddle(sketch.model(), curve.data.front())) return;
  if (beginsSquare(sketch, curve)) return;
  const Mesh& mesh = sketch.mesh();
  const double all = arcsOf(mesh, curve)[curve.linkCount()];
  const double first = length(mesh, curve.links.front());
  const auto sharing = DataPoints(sketch.design()).curvesAt(toModelPoint(mesh, curve.data[1]));
  const bool isOthers = std::any_of(sharing.begin(), sharing.end(), [&](std::size_t c) {
    return sketch.design().curves[c].id != id;
  });
  const bool isFree =
      curve.data.size() > 2 && !curve.isControl[1] && !isOthers && first < kLongLink * all;
  const auto square =
      squareEnd(sketch, curve, isFree ? first : std::min(first / 3, kLongLink * all));
  if (!square) return;
  WorkCurve made = curve;
  if (isFree) {
    made.data[1] = *square;
  } else {
    made.data.insert(made.data.begin() + 1, *square);
    made.isControl.insert(made.isControl.begin() + 1, false);
    made.isCorner.insert(made.isCorner.begin() + 1, false);
    made.links.insert(made.links.begin() + 1, SurfacePath{});
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double step = (position(mesh, made.data[i]) - position(mesh, made.data[i + 1])).norm();
    if (step < kSameDataPoint) return;
  }
  if (linkAll(sketch.linker(), made)) curve = std::move(made);
}

}  // namespace toile::detail
