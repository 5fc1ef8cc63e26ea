// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile::studio {

/// What drawing a body needs of it, once per model.
struct BodyShape {
  std::shared_ptr<const ReferenceModel> model;
  std::vector<Eigen::Vector3f> normals;  ///< smooth, per vertex
  std::vector<float> openness;           ///< 0 in a fold .. 1 open to all sides, per vertex
};
/// Normals alone; every place counts as open.
[[nodiscard]] BodyShape makeBodyShape(std::shared_ptr<const ReferenceModel> model);
/// How much of the sky each vertex sees. @par Cost  16 rays per vertex, on all cores
[[nodiscard]] std::vector<float> computeOpenness(const BodyShape& shape);

/// A corner of a triangle as the graphics card takes it.
struct BodyVertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  float openness;
  float strain;  ///< of the chosen measure, 0.1 = 10 %
  std::array<std::uint8_t, 4> colour;
};

enum class BodyColouring { Clay, Fabric, Piece, Strain };
enum class StrainMeasure { Area, Along, Across, Shear };

/// Per face of a flat piece. Along and across are of the grain on the piece as it was unfolded.
[[nodiscard]] std::vector<double> strainOfFaces(const Piece& piece, const FlatPiece& flat,
                                                StrainMeasure measure);
/// The same per vertex, area-weighted.
[[nodiscard]] std::vector<double> strainOfVertices(const Piece& piece, const FlatPiece& flat,
                                                   StrainMeasure measure);

/// Three per triangle. With a pattern of the same model, the triangles of its pieces.
[[nodiscard]] std::vector<BodyVertex> makeBodyVertices(const BodyShape& shape,
                                                       const Pattern* pattern,
                                                       BodyColouring colouring,
                                                       StrainMeasure measure);

}  // namespace toile::studio
