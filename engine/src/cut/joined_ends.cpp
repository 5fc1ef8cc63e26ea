// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/joined_ends.h"

#include <algorithm>
#include <map>

namespace toile::cutting {
namespace {

/// An end this close to a segment was put on it, in mm; rounding is far below, drawing far above.
constexpr double kOnLine = 1e-6;

struct JoinedPoint {
  std::size_t segment = 0;
  double place = 0;  ///< as a fraction of the segment
  SurfacePoint point;
};

void insertPoints(SurfacePath& path, std::vector<JoinedPoint>& points) {
  std::sort(points.begin(), points.end(), [](const JoinedPoint& l, const JoinedPoint& r) {
    return l.segment != r.segment ? l.segment < r.segment : l.place < r.place;
  });
  SurfacePath joined;
  joined.closed = path.closed;
  auto next = points.begin();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    joined.points.push_back(path.points[i]);
    if (i == path.faceOfSegment.size()) break;
    joined.faceOfSegment.push_back(path.faceOfSegment[i]);
    for (; next != points.end() && next->segment == i; ++next) {
      joined.points.push_back(next->point);
      joined.faceOfSegment.push_back(path.faceOfSegment[i]);
    }
  }
  path = std::move(joined);
}

}  // namespace

std::vector<SurfacePath> withJoinedEnds(const Mesh& mesh, std::span<const PlacedCurve> curves) {
  std::map<FaceId, std::vector<SurfacePoint>> endsIn;
  for (const PlacedCurve& curve : curves) {
    if (!isWire(curve.kind) || curve.path.closed) continue;
    for (const SurfacePoint& end : {curve.path.points.front(), curve.path.points.back()}) {
      for (const FaceId face : facesOf(mesh, end)) endsIn[face].push_back(end);
    }
  }
  std::vector<SurfacePath> paths;
  for (const PlacedCurve& curve : curves) {
    SurfacePath& path = paths.emplace_back(curve.path);
    if (!isWire(curve.kind)) continue;
    std::vector<JoinedPoint> joined;
    for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
      const auto ends = endsIn.find(path.faceOfSegment[i]);
      if (ends == endsIn.end()) continue;
      const Eigen::Vector3d a = position(mesh, path.points[i]);
      const Eigen::Vector3d along = position(mesh, path.points[(i + 1) % path.points.size()]) - a;
      const double squared = along.squaredNorm();
      for (const SurfacePoint& end : ends->second) {
        const Eigen::Vector3d toEnd = position(mesh, end) - a;
        const double place = squared > 0 ? toEnd.dot(along) / squared : 0;
        if (!(place > 0 && place < 1) || (toEnd - place * along).norm() > kOnLine) continue;
        joined.push_back({i, place, end});
      }
    }
    if (!joined.empty()) insertPoints(path, joined);
  }
  return paths;
}

}  // namespace toile::cutting
