// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/layout/layout.h"

namespace toile {

/// The two halves of the guiding map.
enum class Chart {
  Front,  ///< the model seen from the front: (x, z), the wearer's right on the left of the sheet
  Back    ///< the model seen from behind: (-x, z)
};

struct ChartPlace {
  Chart chart = Chart::Front;
  Placement placement;  ///< of the flat piece into the chart
};

/// The chart that the piece faces (to the side counts as front) and the rigid motion that brings
/// its flat positions closest to it: least squares over the surface.
[[nodiscard]] ChartPlace placeOnChart(const Piece& piece, const FlatPiece& flat);

}  // namespace toile
