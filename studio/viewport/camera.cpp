// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile::studio {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

constexpr double kHalfFieldOfView = 12.0 * pi / 180.0;  // long enough a lens to judge lengths by
constexpr double kLeastHeight = 20;                     // mm
constexpr double kMostHeight = 20000;

struct Frame {
  Vector3d back, right, up;
};

Frame frameOf(const Camera& camera) {
  const double ca = std::cos(camera.azimuth), sa = std::sin(camera.azimuth);
  const double ce = std::cos(camera.elevation), se = std::sin(camera.elevation);
  return {{sa * ce, -ca * ce, se}, {ca, sa, 0}, {-sa * se, ca * se, ce}};
}

}  // namespace

View Camera::view() const {
  const Frame frame = frameOf(*this);
  View view;
  view.target = target;
  view.eye = target + 0.5 * height / std::tan(kHalfFieldOfView) * frame.back;
  view.up = frame.up;
  view.height = height;
  return view;
}

Camera turned(Camera camera, const Vector2d& drag, const Screen& screen) {
  const double perPixel = pi / std::max(screen.width, 200.0);
  camera.azimuth = std::remainder(camera.azimuth - drag.x() * perPixel, 2 * pi);
  camera.elevation = std::clamp(camera.elevation + drag.y() * perPixel, -pi / 2, pi / 2);
  return camera;
}

Camera panned(Camera camera, const Vector2d& drag, const Screen& screen) {
  const Frame frame = frameOf(camera);
  const double scale = camera.height / screen.height;
  camera.target += scale * (drag.y() * frame.up - drag.x() * frame.right);
  return camera;
}

Camera zoomed(Camera camera, double factor, const Vector2d& pixel, const Screen& screen) {
  const double height = std::clamp(camera.height / factor, kLeastHeight, kMostHeight);
  const Frame frame = frameOf(camera);
  const Vector2d place = screen.toPlane(pixel);
  const double moved = 1 - height / camera.height;
  camera.target += moved * (place.x() * frame.right + place.y() * frame.up);
  camera.height = height;
  return camera;
}

Camera fitted(Camera camera, const Vector3d& boxMin, const Vector3d& boxMax, double aspect) {
  const Frame frame = frameOf(camera);
  double halfWidth = 0, halfHeight = 0, depth = 0;
  const Vector3d half = 0.5 * (boxMax - boxMin);
  for (int corner = 0; corner < 4; ++corner) {
    const Vector3d c(half.x(), corner & 1 ? half.y() : -half.y(),
                     corner & 2 ? half.z() : -half.z());
    halfWidth = std::max(halfWidth, std::abs(c.dot(frame.right)));
    halfHeight = std::max(halfHeight, std::abs(c.dot(frame.up)));
    depth = std::max(depth, std::abs(c.dot(frame.back)));
  }
  constexpr double kMargin = 1.08;
  camera.target = 0.5 * (boxMin + boxMax);
  const double needed = 2 * std::max(halfHeight, halfWidth / std::max(aspect, 0.1));
  // What stands before the target looks larger.
  camera.height = std::clamp(kMargin * needed + 2 * depth * std::tan(kHalfFieldOfView),
                             kLeastHeight, kMostHeight);
  return camera;
}

Camera seenFrom(Camera camera, StandardView side) {
  camera.elevation = 0;
  switch (side) {
    case StandardView::Front:
      camera.azimuth = 0;
      break;
    case StandardView::Back:
      camera.azimuth = pi;
      break;
    case StandardView::Left:
      camera.azimuth = pi / 2;
      break;
    case StandardView::Right:
      camera.azimuth = -pi / 2;
      break;
    case StandardView::Top:
      camera.azimuth = 0;
      camera.elevation = pi / 2;
      break;
    case StandardView::Bottom:
      camera.azimuth = 0;
      camera.elevation = -pi / 2;
      break;
  }
  return camera;
}

Camera lookingAlong(Camera camera, const Vector3d& normal) {
  const double flat = std::hypot(normal.x(), normal.y());
  if (flat > 1e-6 * normal.norm()) camera.azimuth = std::atan2(normal.x(), -normal.y());
  camera.elevation = std::atan2(normal.z(), flat);
  return camera;
}

Camera between(const Camera& from, const Camera& to, double t) {
  Camera camera;
  camera.target = (1 - t) * from.target + t * to.target;
  camera.azimuth = from.azimuth + t * std::remainder(to.azimuth - from.azimuth, 2 * pi);
  camera.elevation = (1 - t) * from.elevation + t * to.elevation;
  camera.height = from.height * std::pow(to.height / from.height, t);
  return camera;
}

}  // namespace toile::studio
