// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "finish/polygon.h"
#include "toile/layout/pattern.h"

namespace toile {

/// The model from one side as areas to fill by the even-odd rule: in half dots, y up, from (0, 0).
struct BodyView {
  std::string from;  ///< "the front"
  Eigen::Vector2d size{0, 0};
  double mmPerUnit = 1;                      ///< of the model
  std::vector<Points2> body;                 ///< its silhouette
  std::vector<Points2> shade, deepShade;     ///< what turns away from the light
  std::vector<std::vector<Points2>> pieces;  ///< per pattern piece: what is seen of it
};

/// The sides from which the pieces are seen well, and for each pattern piece the one that shows
/// most of it; front and back are preferred a little, since people know them best.
struct BodyViews {
  std::vector<BodyView> views;
  std::vector<std::size_t> viewOf;  ///< per pattern piece
};
[[nodiscard]] BodyViews bodyViews(const Pattern& pattern);

}  // namespace toile
