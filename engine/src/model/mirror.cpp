// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/mirror.h"

#include <algorithm>

namespace toile::detail {

namespace {

/// The face between the partners of a face's corners, and where each of its corners went.
struct MirroredFace {
  FaceId face;
  std::array<std::size_t, 3> cornerOf{};  ///< corner k of the original is corner cornerOf[k]
};

MirroredFace mirroredFace(const Mesh& mesh, const VertexData<VertexId>& partner, FaceId face) {
  const Triangle& corners = mesh.vertices(face);
  for (const FaceId candidate : mesh.facesAround(partner[corners[0]])) {
    const Triangle& others = mesh.vertices(candidate);
    MirroredFace found{candidate, {}};
    std::size_t matches = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::find(others.begin(), others.end(), partner[corners[k]]);
      if (at == others.end()) break;
      found.cornerOf[k] = static_cast<std::size_t>(at - others.begin());
      ++matches;
    }
    if (matches == 3) return found;
  }
  return {};  // only a pairing that is no automorphism gets here
}

}  // namespace

SurfacePoint mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                      const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) return {partner[*v]};
  if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    const VertexId tail = partner[mesh.tail(on->edge)], head = partner[mesh.head(on->edge)];
    const EdgeId edge = mesh.findEdge(tail, head);
    TOILE_ASSERT(edge.isValid());
    return {SurfacePoint::OnEdge{edge, tail < head ? on->t : 1 - on->t}};
  }
  const auto& in = std::get<SurfacePoint::InFace>(point.at);
  const MirroredFace image = mirroredFace(mesh, partner, in.face);
  TOILE_ASSERT(image.face.isValid());
  Eigen::Vector3d weights;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[static_cast<Eigen::Index>(image.cornerOf[k])] =
        in.barycentric[static_cast<Eigen::Index>(k)];
  }
  return {SurfacePoint::InFace{image.face, weights}};
}

SurfacePath mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                     const SurfacePath& path) {
  SurfacePath image;
  image.closed = path.closed;
  for (const SurfacePoint& point : path.points) {
    image.points.push_back(mirrored(mesh, partner, point));
  }
  for (const FaceId face : path.faceOfSegment) {
    image.faceOfSegment.push_back(mirroredFace(mesh, partner, face).face);
  }
  return image;
}

Result<SurfacePoint> mirrored(const ReferenceModel& model, const SurfacePoint& point) {
  if (!model.symmetry) {
    return Error{ErrorCode::CurveInvalid,
                 "the model has no symmetry to mirror a curve by; give the curve its own way",
                 {}};
  }
  const Symmetry& symmetry = *model.symmetry;
  if (!symmetry.partner.empty()) return mirrored(*model.mesh, symmetry.partner, point);
  const Eigen::Vector3d p = position(*model.mesh, point);
  const double distance = symmetry.normal.dot(p) - symmetry.offset;
  return model.index->closestPoint(p - 2 * distance * symmetry.normal).point;
}

}  // namespace toile::detail
