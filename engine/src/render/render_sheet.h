// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "render/picture.h"
#include "toile/render/render.h"

namespace toile {

/// Draws the placed pattern pieces, as large as fits, with a scale bar. Fills the box.
/// @param scale px of this picture per px of the line styles
void paintSheet(Picture& picture, const PixelBox& box, const Pattern& pattern,
                const RenderOptions& options, double scale);

/// The height, px, of a box of that width in which pieces of that size (mm) are no larger.
[[nodiscard]] double sheetHeight(int width, const Eigen::Vector2d& size, double scale);

struct Caption {
  std::string text;
  double x = 0, y = 0;  ///< px, left end of the base line; the middle of it when centred
  double size = 13;     ///< px of type
  bool bold = false;
  bool centred = false;
};
void drawCaption(Picture& picture, const Caption& caption);

}  // namespace toile
