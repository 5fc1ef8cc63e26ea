// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "document/piece_colours.h"
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

/// Per vertex of a piece, the mean of the faces around it by their area.
[[nodiscard]] std::vector<float> strainOfVertices(const Mesh& mesh, const PieceStrain& strain,
                                                  StrainKind kind);

/// How the pieces of a pattern are coloured.
struct BodyPaint {
  PieceColours colours = PieceColours::Fabric;
  bool strain = false;  ///< in place of the colours
  StrainKind kind = StrainKind::Area;
  /// Of the pattern's pieces; null: none is known.
  const std::vector<std::optional<PieceStrain>>* strains = nullptr;
};

/// Three per triangle. With a pattern of the same model, the triangles of its pieces.
[[nodiscard]] std::vector<BodyVertex> makeBodyVertices(const BodyShape& shape,
                                                       const Pattern* pattern,
                                                       const BodyPaint& paint);

}  // namespace toile::studio
