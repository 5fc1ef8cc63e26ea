// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/colour.h"
#include "toile/layout/pattern.h"

namespace toile {

/// How much the cloth must give at a face: body area / flat area - 1. Positive: it must stretch;
/// negative: there is too much of it.
[[nodiscard]] double strainOf(const FaceDistortion& distortion);

/// The end of the colour scale for a pattern: the least of 5, 10, 20, 40 % that holds 95 % of the
/// unfolded area.
[[nodiscard]] double strainScale(const Pattern& pattern);

/// For a strain divided by the scale; beyond -1..1 the end colours.
[[nodiscard]] Colour strainColour(double relative);

/// An <svg> of one flat piece: strain in colours, wires as lines, y up turned into y down.
[[nodiscard]] std::string strainMapSvg(const Piece& piece, const FlatPiece& flat, double scale);

/// An <svg> bar that explains the colours.
[[nodiscard]] std::string strainLegendSvg(double scale);

}  // namespace toile
