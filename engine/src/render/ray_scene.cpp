// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/ray_scene.h"

#include <cstring>
#include <utility>

namespace toile {
namespace {

RTCRay makeRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near,
               float far) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = 0xffffffffU;
  return ray;
}

void fillTriangles(RTCGeometry geometry, std::span<const Eigen::Vector3f> positions,
                   std::span<const std::uint32_t> corners) {
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), positions.size()));
  for (const Eigen::Vector3f& p : positions) {
    std::memcpy(vertices, p.data(), 3 * sizeof(float));
    vertices += 3;
  }
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), corners.size() / 3);
  std::memcpy(indices, corners.data(), corners.size_bytes());
}

}  // namespace

RayScene::RayScene(std::span<const Eigen::Vector3f> positions,
                   std::span<const std::uint32_t> corners)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  fillTriangles(geometry, positions, corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // no light through the edges of the mesh
  rtcCommitScene(scene_);
}

RayScene RayScene::ofTriangles(std::span<const Eigen::Vector3f> positions,
                               std::span<const std::uint32_t> corners) {
  if (corners.empty()) return {};
  return RayScene(positions, corners);
}

RayScene::~RayScene() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

RayScene::RayScene(RayScene&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)),
      scene_(std::exchange(other.scene_, nullptr)) {}

RayScene& RayScene::operator=(RayScene&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(scene_, other.scene_);
  return *this;
}

FirstHit RayScene::firstHit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                            float near, float far) const {
  FirstHit result;
  if (scene_ == nullptr) return result;
  RTCRayHit query{};
  query.ray = makeRay(origin, direction, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return result;
  result.primitive = query.hit.primID;
  result.t = query.ray.tfar;
  result.u = query.hit.u;
  result.v = query.hit.v;
  return result;
}

bool RayScene::isBlocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                         float near, float far) const {
  if (scene_ == nullptr) return false;
  RTCRay ray = makeRay(origin, direction, near, far);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace toile
