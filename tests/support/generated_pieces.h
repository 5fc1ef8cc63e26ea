// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toile/cut/cut.h"

namespace toile::test {

struct GeneratedPiece {
  std::string name;
  Piece piece;
  bool isFeasible = true;       ///< the lengths of its wires can all be kept
  bool overlapsItself = false;  ///< a spiral, a dart where the curvature is negative
  /// Wires alone, without cloth between them, have their minimum where they cross.
  bool wiresCross = false;
};

/// Forty pieces of all kinds that make unfolding hard: caps of 30 to 120 degrees with features that
/// cross, end, float, close or open as darts; saddles, torus and bumpy patches, bent sleeves, a
/// spiral strip, a ridge, needles, rings with a hole, over-braced networks.
std::vector<GeneratedPiece> generatedPieces();

}  // namespace toile::test
