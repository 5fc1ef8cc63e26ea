// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/transfer/names.h"

#include <Eigen/Geometry>

#include "toile/curve/geodesic.h"
#include "toile/model/guiding_map.h"

namespace toile {

namespace {

/// Pairs of vertices that the mirror plane is fitted to: more make it no better.
constexpr std::size_t kPairs = 2000;
constexpr double kSamePoint = 1e-6;  ///< mm; neighbours of a curve closer than this are one

/// The plane that fits the images of paired vertices best.
Symmetry carryPlane(const ReferenceModel& names, const ReferenceModel& target,
                    const Correspondence& map) {
  const Mesh& mesh = *names.mesh;
  const Symmetry& own = *names.symmetry;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
  double count = 0;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertexCount() / kPairs);
  const auto image = [&](const SurfacePoint& point) {
    return position(*target.mesh, map.toB(point));
  };
  for (std::size_t i = 0; i < mesh.vertexCount(); i += step) {
    const VertexId v(i);
    const Eigen::Vector3d p = mesh.position(v);
    const double side = own.normal.dot(p) - own.offset;
    SurfacePoint partner;
    if (own.partner.empty()) {
      partner = names.index->closestPoint(p - 2 * side * own.normal).point;
    } else {
      partner = SurfacePoint{own.partner[v]};
    }
    const Eigen::Vector3d a = image(SurfacePoint{v}), b = image(partner);
    normal += side >= 0 ? a - b : b - a;
    middle += (a + b) / 2;
    ++count;
  }
  Symmetry plane;
  if (normal.norm() > 0) plane.normal = normal.normalized();
  plane.offset = count > 0 ? plane.normal.dot(middle) / count : 0;
  return plane;
}

Result<SurfacePath> carryPath(const ReferenceModel& target, const Correspondence& map,
                              GeodesicLinker& linker, const SurfacePath& path) {
  std::vector<SurfacePoint> points;
  const auto isSame = [&](const SurfacePoint& a, const SurfacePoint& b) {
    return a == b || (position(*target.mesh, a) - position(*target.mesh, b)).norm() < kSamePoint;
  };
  for (const SurfacePoint& point : path.points) {
    const SurfacePoint image = map.toB(point);
    if (points.empty() || !isSame(points.back(), image)) points.push_back(image);
  }
  while (path.closed && points.size() > 1 && isSame(points.front(), points.back())) {
    points.pop_back();
  }
  return linker.linkAll(points, path.closed);
}

/// The names' own guiding map on the target's faces.
std::shared_ptr<GuidingMapSlot> carryMap(const ReferenceModel& names, const ReferenceModel& target,
                                         const Correspondence& map) {
  const Mesh& mesh = *target.mesh;
  const bool isSameMesh = names.mesh->connectivityHash() == mesh.connectivityHash();
  FaceData<FaceId> sourceFace(mesh.faceCount());
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const FaceId face(f);
    const SurfacePoint middle{SurfacePoint::InFace{face, Eigen::Vector3d::Constant(1.0 / 3)}};
    sourceFace[face] = isSameMesh ? face : facesOf(*names.mesh, map.toA(middle)).front();
  }
  return std::make_shared<GuidingMapSlot>(carryGuidingMap(*guidingMap(names), target, sourceFace));
}

}  // namespace

Result<ReferenceModel> carryNames(const ReferenceModel& names, const ReferenceModel& target,
                                  const Correspondence& map) {
  ReferenceModel model = target;
  const bool isSameMesh = names.mesh->connectivityHash() == target.mesh->connectivityHash();
  GeodesicLinker linker(target.mesh);
  for (const auto& [name, path] : names.curves) {
    if (model.curves.contains(name)) continue;
    if (isSameMesh) {
      model.curves[name] = path;
      continue;
    }
    Result<SurfacePath> carried = carryPath(target, map, linker, path);
    if (!carried) return carried.error().during("model curve \"" + name + "\"");
    model.curves[name] = *std::move(carried);
  }
  for (const auto& [name, point] : names.landmarks) {
    model.landmarks.emplace(name, isSameMesh ? point : map.toB(point));
  }
  const bool hasPairing = model.symmetry && !model.symmetry->partner.empty();
  if (names.symmetry && !hasPairing) {
    if (isSameMesh && !names.symmetry->partner.empty()) {
      model.symmetry = makeSymmetry(*model.mesh, names.symmetry->partner);
    } else if (!model.symmetry) {
      model.symmetry = carryPlane(names, target, map);
    }
  }
  const bool hasMap = model.map && model.map->isGiven();
  if (names.map && names.map->isGiven() && !hasMap) model.map = carryMap(names, model, map);
  return model;
}

}  // namespace toile
