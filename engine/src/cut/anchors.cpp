// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/anchors.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace toile::cutting {

FaceId findRefinedFace(const Mesh& model, const RefinedMesh& refined, const SurfacePoint& point) {
  const FaceId source = facesOf(model, point).front();
  const Eigen::Vector3d weights = barycentricIn(model, point, source);
  const auto& sources = refined.sourceFace.values();
  const auto range = std::equal_range(sources.begin(), sources.end(), source);
  FaceId best;
  double bestInside = -std::numeric_limits<double>::infinity();
  for (auto at = range.first; at != range.second; ++at) {
    const FaceId f(static_cast<std::size_t>(at - sources.begin()));
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const VertexId v = refined.mesh.vertices(f)[static_cast<std::size_t>(k)];
      corners.col(k) = barycentricIn(model, refined.onModel[v], source);
    }
    const double inside = corners.partialPivLu().solve(weights).minCoeff();
    if (inside > bestInside) {
      best = f;
      bestInside = inside;
    }
  }
  return best;
}

Result<std::vector<std::vector<int>>> assignRecords(const Document& document,
                                                    const std::vector<PlacedCurve>&,
                                                    const RefinedMesh& refined,
                                                    const FaceData<std::uint32_t>& regionOfFace,
                                                    std::size_t regionCount) {
  std::vector<std::vector<int>> recordsOf(regionCount);
  const std::vector<PieceRecord>& records = document.design->pieces;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const auto* point = std::get_if<ModelPoint>(&records[r].anchor);
    if (point == nullptr) {
      return Error{ErrorCode::Unsupported,
                   "piece \"" + records[r].id + "\" is anchored by a name; use a surface point",
                   {Element::piece(records[r].id)}};
    }
    const Result<SurfacePoint> anchor = toSurfacePoint(*document.model->mesh, *point);
    if (!anchor) return anchor.error().during("anchor of piece \"" + records[r].id + "\"");
    const FaceId f = findRefinedFace(*document.model->mesh, refined, *anchor);
    recordsOf[regionOfFace[f]].push_back(static_cast<int>(r));
  }
  return recordsOf;
}

}  // namespace toile::cutting
