// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/cut/on_model.h"

namespace toile {

SurfacePoint pointOnModel(const Piece& piece, const Mesh& model, const SurfacePoint& point) {
  if (const auto* v = std::get_if<VertexId>(&point.at)) return piece.onModel[*v];
  const FaceId f = facesOf(*piece.mesh, point).front();
  const FaceId source = piece.sourceFace[f];
  const Eigen::Vector3d weights = barycentricIn(*piece.mesh, point, f);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const VertexId corner = piece.mesh->vertices(f)[static_cast<std::size_t>(k)];
    sum += weights[k] * barycentricIn(model, piece.onModel[corner], source);
  }
  return makeSurfacePoint(model, source, sum);
}

StylingCurve makeCurveOnModel(const Piece& piece, const Mesh& model,
                              const std::vector<SurfacePoint>& points, std::string id,
                              std::string name, CurveKind kind) {
  StylingCurve curve;
  curve.id = std::move(id);
  curve.name = std::move(name);
  curve.kind = kind;
  for (const SurfacePoint& p : points) {
    const ModelPoint at = toModelPoint(model, pointOnModel(piece, model, p));
    if (curve.dataPoints.empty() || !(curve.dataPoints.back() == at))
      curve.dataPoints.push_back(at);
  }
  curve.way = ShortestWay{{curve.dataPoints.front(), curve.dataPoints.back()}, {}};
  return curve;
}

}  // namespace toile
