// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile {

/// The three lengths of a wire or of a whole seam, mm.
struct Lengths {
  double body = 0;
  double target = 0;
  double flat = 0;
};

struct WireMate {
  std::uint32_t piece = 0;  ///< index in cut.pieces
  std::uint32_t wire = 0;
};

struct WireReport {
  Lengths lengths;
  double maxEdgeError = 0;  ///< max over edges of |flat - target| / max(target, 1 mm)
  std::optional<WireMate> mate;
};

/// Least, mean (weighted by area on the body) and greatest value over the faces of a piece.
struct Spread {
  double min = 0;
  double mean = 0;
  double max = 0;
};

struct PieceReport {
  double bodyArea = 0;  ///< mm^2
  double flatArea = 0;  ///< mm^2, 0 without flat piece
  Spread stretchMin, stretchMax;
  Spread areaRatio;
  std::optional<PieceStrain> strain;  ///< of pattern pieces
  std::vector<WireReport> wires;      ///< flat lengths are 0 without flat piece
};

struct ReportData {
  std::vector<PieceReport> pieces;  ///< per piece of the cut
  double includedArea = 0;          ///< sum of the areas of the included pieces
  double flatArea = 0;
  double maxEdgeError = 0;
  std::size_t wireEdges = 0;  ///< of unfolded pieces
  std::size_t unfolded = 0;
};

/// Measures everything that the reports tell from the pattern itself, not from its checks.
ReportData measure(const Pattern& pattern);

}  // namespace toile
