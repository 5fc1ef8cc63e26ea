// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/model/write_model.h"

#include <nlohmann/json.hpp>

namespace toile {

namespace {

using Json = nlohmann::ordered_json;

Json weightsOf(const Mesh& mesh, const SurfacePoint& point, FaceId face) {
  const Eigen::Vector3d w = barycentricIn(mesh, point, face);
  return Json::array({w[0], w[1], w[2]});
}

Json curveOf(const Mesh& mesh, const SurfacePath& path) {
  Json tri = Json::array(), bary = Json::array();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    // The last point of an open curve lies in the face of the segment that ends there.
    const FaceId face = path.faceOfSegment[std::min(i, path.faceOfSegment.size() - 1)];
    tri.push_back(face.index());
    bary.push_back(weightsOf(mesh, path.points[i], face));
  }
  return {{"closed", path.closed}, {"tri", std::move(tri)}, {"bary", std::move(bary)}};
}

Json landmarkOf(const Mesh& mesh, const SurfacePoint& point) {
  if (const auto* vertex = std::get_if<VertexId>(&point.at)) return vertex->index();
  const FaceId face = facesOf(mesh, point).front();
  return {{"tri", face.index()}, {"bary", weightsOf(mesh, point, face)}};
}

}  // namespace

std::string writeModelFile(const ReferenceModel& model, const std::string& meshFile) {
  const Mesh& mesh = *model.mesh;
  Json json = {{"toile-model", 1}, {"name", model.name}, {"mesh", meshFile}};
  if (!model.curves.empty()) {
    Json& curves = json["curves"] = Json::object();
    for (const auto& [name, path] : model.curves) curves[name] = curveOf(mesh, path);
  }
  if (!model.landmarks.empty()) {
    Json& landmarks = json["landmarks"] = Json::object();
    for (const auto& [name, point] : model.landmarks) landmarks[name] = landmarkOf(mesh, point);
  }
  if (!model.symmetry) {
    json["symmetry"] = nullptr;
  } else {
    const Symmetry& symmetry = *model.symmetry;
    const Eigen::Vector3d& n = symmetry.normal;
    Json& written =
        json["symmetry"] = {{"normal", {n.x(), n.y(), n.z()}}, {"offset", symmetry.offset}};
    if (!symmetry.partner.empty()) {
      Json& partner = written["partner"] = Json::array();
      for (const VertexId v : symmetry.partner.values()) partner.push_back(v.index());
    }
  }
  return json.dump() + "\n";
}

}  // namespace toile
