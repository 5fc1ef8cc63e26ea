// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/camera.h"

#include <Eigen/Geometry>
#include <cmath>

namespace toile {
namespace {

constexpr double kEyeDistance = 5;  // in diagonals: nearly parallel, yet round

}  // namespace

Camera makeCamera(const Eigen::Vector3d& middle, double diagonal, const RenderView& view) {
  const double turn = view.azimuth.radians();
  const double above = view.elevation.radians();
  Camera camera;
  const Eigen::Vector3d out(std::cos(above) * std::sin(turn), -std::cos(above) * std::cos(turn),
                            std::sin(above));
  camera.distance = kEyeDistance * diagonal;
  camera.eye = middle + camera.distance * out;
  camera.forward = -out;
  camera.right = {std::cos(turn), std::sin(turn), 0};
  camera.up = camera.right.cross(camera.forward);
  return camera;
}

Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector3d d = point - camera.eye;
  const double scale = camera.distance / d.dot(camera.forward);
  return {scale * d.dot(camera.right), scale * d.dot(camera.up)};
}

}  // namespace toile
