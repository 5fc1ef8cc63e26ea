// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <QString>
#include <optional>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile::studio {

/// A place where the cloth must give most, numbered as in the list.
struct PlacedSpot {
  int number = 1;
  std::size_t piece = 0;  ///< index in Pattern::cut.pieces
  StrainSpot spot;
  Eigen::Vector3d place, normal;  ///< on the body
  bool isOverLimit = false;
};

/// The worst places of a pattern: those over the limit of their fabric first, then the greatest.
/// Area has no limit and no spots of its own: of it, those of all kinds.
[[nodiscard]] std::vector<PlacedSpot> worstSpots(
    const Pattern& pattern, const std::vector<std::optional<PieceStrain>>& strains,
    StrainKind kind);

/// "+39 %", with a real minus sign.
[[nodiscard]] QString percentText(double share, int decimals = 0);

}  // namespace toile::studio
