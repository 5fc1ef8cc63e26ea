// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "render/colour.h"
#include "toile/layout/pattern.h"
#include "toile/render/render.h"

namespace toile {

inline constexpr Colour kMannequin = colourOf(0xD3C8BC);  ///< what is left out of the design

struct PanelColours {
  std::vector<Colour> onModel;  ///< per piece of the cut
  std::vector<Colour> flat;     ///< the same, pale enough for lines and labels on it
};

/// Product: the colour of the piece's fabric where it has one, otherwise cloth colours that go
/// together. Plain: pale tints. Mirror images of each other share a colour, neighbours across a
/// seam differ as far as the palette goes round, large pieces take its first colours.
[[nodiscard]] PanelColours panelColours(const Pattern& pattern, RenderStyle style);

/// Per piece the smallest index of the pieces that are its mirror images by the model's symmetry,
/// its own included.
[[nodiscard]] std::vector<std::size_t> mirrorClasses(const CutResult& cut,
                                                     const ReferenceModel& model);

}  // namespace toile
