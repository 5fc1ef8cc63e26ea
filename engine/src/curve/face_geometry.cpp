// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/face_geometry.h"

#include <Eigen/Geometry>
#include <cmath>

namespace toile::detail {

double FaceGeometry::angleAround(VertexId v) {
  double sum = 0;
  const HalfedgeId first = mesh_.outgoing(v);
  for (HalfedgeId h = first; h.isValid();) {
    sum += cornerAngle(h);
    h = mesh_.opposite(mesh_.previous(h));
    if (h == first) break;
  }
  return sum;
}

void FaceGeometry::measure(FaceId f, Face& entry) const {
  const Triangle& corners = mesh_.vertices(f);
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& from = mesh_.position(corners[k]);
    const Eigen::Vector3d along = mesh_.position(corners[(k + 1) % 3]) - from;
    const Eigen::Vector3d toApex = mesh_.position(corners[(k + 2) % 3]) - from;
    const double square = along.squaredNorm();
    const double dot = along.dot(toApex), twiceArea = along.cross(toApex).norm();
    // An edge without length has no direction; its face then unfolds to nothing.
    entry.apex[k] = square > 0 ? Apex{dot / square, twiceArea / square} : Apex{};
    entry.angle[k] = std::atan2(twiceArea, dot);
  }
  entry.isKnown = true;
}

}  // namespace toile::detail
