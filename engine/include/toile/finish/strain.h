// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "toile/finish/pattern_piece.h"

namespace toile {

/// What is told of the strain of cloth.
enum class StrainKind {
  Area,
  Along,  ///< along the grain
  Across,
  Shear
};
inline constexpr std::array kStrainKinds = {StrainKind::Area, StrainKind::Along, StrainKind::Across,
                                            StrainKind::Shear};
[[nodiscard]] std::string_view toString(StrainKind kind);  ///< "area", "along", ...

/// How the cloth of the pattern must change to take its shape on the body, ease not counted: shares
/// of its own size, positive where it must stretch, negative where there is too much of it.
struct Strain {
  double greatest = 0;  ///< of all directions
  double least = 0;
  double area = 0;
  double along = 0;  ///< of the threads along the grain
  double across = 0;
  double shear = 0;  ///< >= 0: tangent of the angle by which the threads leave the right angle
  [[nodiscard]] double of(StrainKind kind) const;
};

/// What a fabric bears; nothing where the design does not say.
struct StrainLimits {
  std::optional<double> along, across, shear;
  [[nodiscard]] std::optional<double> of(StrainKind kind) const;
};
[[nodiscard]] StrainLimits strainLimits(const Design& design, const std::string& pieceId);

/// A place where the cloth must give more than around it.
struct StrainSpot {
  VertexId vertex;  ///< of the piece's mesh
  StrainKind kind = StrainKind::Across;
  double value = 0;             ///< of Strain, mean round the vertex
  std::optional<double> limit;  ///< of the fabric
  std::string place;            ///< "12 cm below the front of the neck"
  [[nodiscard]] bool isOverLimit() const { return limit && value > *limit; }
};
/// "6.1 % stretch across the grain", "4.0 % too much cloth along the grain, limit ..."
[[nodiscard]] std::string describe(const StrainSpot& spot);

/// The strain of one piece.
struct PieceStrain {
  FaceData<Strain> faces;
  StrainLimits limits;
  double overLimit = 0;           ///< share of the area where any limit is passed
  std::vector<StrainSpot> worst;  ///< over their limits first, then the greatest; at most three
};

/// Strain per face, and the worst places in words: by the nearest landmark of the model, or where
/// it has none, by the nearest edge of the piece.
///
/// @param piece in the shape that `flat` is the plane of (Pattern::shapedPiece()).
/// @param finished the same piece: its grain.
/// @par Cost  linear in the faces
[[nodiscard]] PieceStrain measureStrain(const Document& document, const Piece& piece,
                                        const FlatPiece& flat, const PatternPiece& finished);

}  // namespace toile
