// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "toile/design/design.h"

namespace toile {
namespace {

/// What the weights written by another program may miss 1 by, from rounding.
constexpr double kWeightSumTolerance = 1e-9;

Error missing(const std::string& what) {
  return {ErrorCode::ModelMismatch,
          "the model has no " + what + "; was the design drawn on another one?",
          {}};
}

Result<SurfacePoint> edgePoint(const Mesh& mesh, const ModelPoint::OnEdge& point) {
  const std::string name =
      std::to_string(point.tail.index()) + "-" + std::to_string(point.head.index());
  const std::size_t count = mesh.vertexCount();
  const bool known = point.tail.index() < point.head.index() && point.head.index() < count;
  const EdgeId edge = known ? mesh.findEdge(point.tail, point.head) : EdgeId();
  if (!edge.isValid()) return missing("edge between the vertices " + name);
  if (!(point.t > 0 && point.t < 1)) {
    return Error{ErrorCode::CurveInvalid,
                 "the point on edge " + name + " must lie between its ends (0 < t < 1)",
                 {Element::edge(edge)}};
  }
  return SurfacePoint{SurfacePoint::OnEdge{edge, point.t}};
}

Result<SurfacePoint> facePoint(const Mesh& mesh, const SurfacePoint::InFace& point) {
  const std::string name = std::to_string(point.face.index());
  if (point.face.index() >= mesh.faceCount()) return missing("face " + name);
  const Eigen::Vector3d& weights = point.barycentric;
  if (!(weights.minCoeff() > 0) || !(std::abs(weights.sum() - 1) <= kWeightSumTolerance)) {
    return Error{ErrorCode::CurveInvalid,
                 "the weights of the point in face " + name + " must be above 0 and add up to 1",
                 {Element::face(point.face)}};
  }
  return SurfacePoint{point};
}

}  // namespace

ModelPoint toModelPoint(const Mesh& mesh, const SurfacePoint& point) {
  if (const auto* vertex = std::get_if<VertexId>(&point.at)) return {*vertex};
  if (const auto* onEdge = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    return {ModelPoint::OnEdge{mesh.tail(onEdge->edge), mesh.head(onEdge->edge), onEdge->t}};
  }
  return {std::get<SurfacePoint::InFace>(point.at)};
}

Result<SurfacePoint> toSurfacePoint(const Mesh& mesh, const ModelPoint& point) {
  if (const auto* vertex = std::get_if<VertexId>(&point.at)) {
    if (vertex->index() < mesh.vertexCount()) return SurfacePoint{*vertex};
    return missing("vertex " + std::to_string(vertex->index()));
  }
  if (const auto* onEdge = std::get_if<ModelPoint::OnEdge>(&point.at)) {
    return edgePoint(mesh, *onEdge);
  }
  return facePoint(mesh, std::get<SurfacePoint::InFace>(point.at));
}

}  // namespace toile
