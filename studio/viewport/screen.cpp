// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/screen.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace toile::studio {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

struct Axes {
  Vector3d right, up, forward;
  double distance;
};

Axes axesOf(const View& view) {
  const Vector3d way = view.target - view.eye;
  const Vector3d forward = way.normalized();
  const Vector3d right = forward.cross(view.up).normalized();
  return {right, right.cross(forward), forward, way.norm()};
}

}  // namespace

Vector2d Screen::toPlane(const Vector2d& pixel) const {
  const double scale = view.height / height;
  return {(pixel.x() - 0.5 * width) * scale, (0.5 * height - pixel.y()) * scale};
}

Ray Screen::rayAt(const Vector2d& pixel) const {
  return rayThrough(view, toPlane(pixel));
}

std::optional<Vector2d> Screen::toPixel(const Vector3d& place) const {
  const Axes axes = axesOf(view);
  const Vector3d from = place - view.eye;
  const double depth = from.dot(axes.forward);
  if (view.perspective && depth < 1e-3 * axes.distance) return std::nullopt;
  const double shrink = view.perspective ? axes.distance / depth : 1.0;
  const double scale = height / view.height * shrink;
  return Vector2d(0.5 * width + scale * from.dot(axes.right),
                  0.5 * height - scale * from.dot(axes.up));
}

double Screen::mmPerPixelAt(const Vector3d& place) const {
  const Axes axes = axesOf(view);
  const double depth = (place - view.eye).dot(axes.forward);
  return view.height / height * (view.perspective ? std::max(depth, 1.0) / axes.distance : 1.0);
}

Vector3d Screen::towardsEye(const Vector3d& place) const {
  if (!view.perspective) return (view.eye - view.target).normalized();
  return (view.eye - place).normalized();
}

Eigen::Matrix4d Screen::clipFromWorld(const Vector3d& centre, double radius) const {
  const Axes axes = axesOf(view);
  Eigen::Matrix4d eyeFromWorld = Eigen::Matrix4d::Identity();
  eyeFromWorld.block<1, 3>(0, 0) = axes.right.transpose();
  eyeFromWorld.block<1, 3>(1, 0) = axes.up.transpose();
  eyeFromWorld.block<1, 3>(2, 0) = -axes.forward.transpose();
  eyeFromWorld.block<3, 1>(0, 3) = -eyeFromWorld.block<3, 3>(0, 0) * view.eye;

  const double middle = (centre - view.eye).dot(axes.forward);
  const double aspect = width / height;
  const double halfHeight = 0.5 * view.height;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  if (view.perspective) {
    const double far = std::max(middle + radius, 2.0);
    const double near = std::max({middle - radius, 1e-3 * far, 1.0});
    const double focal = axes.distance / halfHeight;
    clip(0, 0) = focal / aspect;
    clip(1, 1) = focal;
    clip(2, 2) = (far + near) / (near - far);
    clip(2, 3) = 2 * far * near / (near - far);
    clip(3, 2) = -1;
  } else {
    const double near = middle - radius;
    const double far = middle + radius;
    clip(0, 0) = 1 / (halfHeight * aspect);
    clip(1, 1) = 1 / halfHeight;
    clip(2, 2) = 2 / (near - far);
    clip(2, 3) = (far + near) / (near - far);
    clip(3, 3) = 1;
  }
  return clip * eyeFromWorld;
}

}  // namespace toile::studio
