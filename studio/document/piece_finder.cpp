// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/piece_finder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace toile::studio {

using Eigen::Vector3d;

namespace {

/// How far outside of a triangle a place in its plane lies: the least barycentric weight, >= 0
/// inside.
double leastWeight(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const double squared = n.squaredNorm();
  if (squared == 0) return std::numeric_limits<double>::lowest();
  const double wa = (c - b).cross(p - b).dot(n) / squared;
  const double wb = (a - c).cross(p - c).dot(n) / squared;
  return std::min({wa, wb, 1 - wa - wb});
}

}  // namespace

PieceFinder::PieceFinder(std::shared_ptr<const Pattern> pattern) : pattern_(std::move(pattern)) {
  for (std::size_t i = 0; i < pattern_->cut.pieces.size(); ++i) {
    const Piece& piece = pattern_->cut.pieces[i];
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      partsOfFace_[piece.sourceFace[FaceId(f)].index()].push_back({i, FaceId(f)});
    }
  }
}

std::optional<std::size_t> PieceFinder::pieceAt(const SurfacePoint& point) const {
  const Mesh& model = *pattern_->document.model->mesh;
  const Vector3d place = position(model, point);
  std::optional<std::size_t> best;
  double most = std::numeric_limits<double>::lowest();
  for (const FaceId face : facesOf(model, point)) {
    const auto parts = partsOfFace_.find(face.index());
    if (parts == partsOfFace_.end()) continue;
    for (const Part& part : parts->second) {
      const Mesh& mesh = *pattern_->cut.pieces[part.piece].mesh;
      const Triangle& corners = mesh.vertices(part.face);
      const double weight = leastWeight(place, mesh.position(corners[0]), mesh.position(corners[1]),
                                        mesh.position(corners[2]));
      if (weight > most) {
        most = weight;
        best = part.piece;
      }
    }
  }
  return best;
}

}  // namespace toile::studio
