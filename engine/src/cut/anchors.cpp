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
                                                    const std::vector<PlacedCurve>& placed,
                                                    const RefinedMesh& refined,
                                                    const FaceData<std::uint32_t>& regionOfFace,
                                                    std::size_t regionCount) {
  std::vector<std::vector<int>> recordsOf(regionCount);
  const std::vector<PieceRecord>& records = document.design->pieces;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Result<SurfacePoint> anchor = resolvePlace(records[r].anchor, *document.model, placed);
    if (!anchor) {
      Error error = anchor.error().during("anchor of piece \"" + records[r].id + "\"");
      error.where.push_back(Element::piece(records[r].id));
      return error;
    }
    const FaceId f = findRefinedFace(*document.model->mesh, refined, *anchor);
    recordsOf[regionOfFace[f]].push_back(static_cast<int>(r));
  }
  return recordsOf;
}

}  // namespace toile::cutting
