// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/middle_line.h"

#include <algorithm>
#include <limits>

#include "model/mirror.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

constexpr double kOnMiddle = 1e-6;  ///< mm that a point of the middle line may lie beside its image

}  // namespace

MiddleLine::MiddleLine(const ReferenceModel& model) {
  if (!model.symmetry) return;
  const Mesh& mesh = *model.mesh;
  const Symmetry& symmetry = *model.symmetry;
  if (symmetry.partner.empty()) {
    for (const SurfacePath& path : model.index->planeSection(symmetry.normal, symmetry.offset)) {
      for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
        segments_.push_back(
            {path.faceOfSegment[i], path.points[i], path.points[(i + 1) % path.points.size()]});
      }
    }
    return;
  }
  const auto& partner = symmetry.partner;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const FaceId face(f);
    const Triangle& t = mesh.vertices(face);
    for (int k = 0; k < 3; ++k) {
      const VertexId a = t[static_cast<std::size_t>(k)],
                     b = t[static_cast<std::size_t>((k + 1) % 3)];
      const VertexId c = t[static_cast<std::size_t>((k + 2) % 3)];
      if (partner[a] == a && partner[b] == b) {
        segments_.push_back({face, {a}, {b}});
      } else if (partner[a] == b && partner[c] == c) {
        const EdgeId edge = mesh.edge(mesh.halfedge(face, k));
        segments_.push_back({face, {c}, {SurfacePoint::OnEdge{edge, 0.5}}});
      }
    }
  }
}

SurfacePoint MiddleLine::nearest(const Mesh& mesh, const Vector3d& place) const {
  double least = std::numeric_limits<double>::infinity();
  SurfacePoint best;
  for (const Segment& segment : segments_) {
    const Vector3d a = position(mesh, segment.a), d = position(mesh, segment.b) - a;
    const double square = d.squaredNorm();
    const double t = square > 0 ? std::clamp((place - a).dot(d) / square, 0.0, 1.0) : 0.0;
    const double distance = (a + t * d - place).norm();
    if (!(distance < least)) continue;
    least = distance;
    best = makeSurfacePoint(mesh, segment.face,
                            (1 - t) * barycentricIn(mesh, segment.a, segment.face) +
                                t * barycentricIn(mesh, segment.b, segment.face));
  }
  return best;
}

double sideOf(const ReferenceModel& model, const SurfacePoint& point) {
  const Symmetry& symmetry = *model.symmetry;
  const Vector3d p = position(*model.mesh, point);
  if (symmetry.partner.empty()) return symmetry.normal.dot(p) - symmetry.offset;
  const SurfacePoint image = mirrored(*model.mesh, symmetry.partner, point);
  return 0.5 * symmetry.normal.dot(p - position(*model.mesh, image));
}

bool isOnMiddle(const ReferenceModel& model, const SurfacePoint& point) {
  if (!model.symmetry) return false;
  const Result<SurfacePoint> image = mirrored(model, point);
  return image && (position(*model.mesh, *image) - position(*model.mesh, point)).norm() < kOnMiddle;
}

}  // namespace toile::detail
