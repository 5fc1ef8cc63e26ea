// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "render/line_paint.h"
#include "render/ray_scene.h"
#include "render/studio_light.h"
#include "render/surface_lines.h"
#include "toile/render/render.h"

namespace toile {

/// What stands in the studio, in floats: one part per piece of the design, or the model alone.
struct RenderScene {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> corners;  ///< three per face
  std::vector<std::uint32_t> partOfFace;
  std::vector<ClothPaint> cloth;  ///< per part
  SurfaceLines lines;
  RayScene surface;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< where the eye looks
  double diagonal = 1;

  /// Light is gathered at the model's vertices, whatever the pieces are cut into.
  struct OnModel {
    std::array<std::uint32_t, 3> vertex;
    Eigen::Vector3f weight;
  };
  std::vector<OnModel> onModel;  ///< per vertex of the scene
  std::vector<Eigen::Vector3f> modelNormals;
  std::vector<std::uint32_t> modelCorners;  ///< three per face
  SkyView sky;                              ///< per vertex of the model

  /// Light at every vertex of the scene, from studioLight().
  [[nodiscard]] std::vector<Eigen::Vector3f> lightAtVertices(
      std::span<const Eigen::Vector3f> light) const;

 private:
  [[nodiscard]] std::vector<Eigen::Vector3f> smoothed(
      const std::vector<Eigen::Vector3f>& light) const;
};

[[nodiscard]] RenderScene makeScene(const Pattern& pattern, const RenderOptions& options);
[[nodiscard]] RenderScene makeScene(const ReferenceModel& model, const RenderOptions& options);

}  // namespace toile
