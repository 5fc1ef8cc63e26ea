// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toile/core/result.h"

namespace toile {

/// A raster of 8-bit sRGB pixels in the memory order of cairo's RGB24: rows from the top, each
/// pixel a native 0x00RRGGBB word.
struct Picture {
  Picture(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::uint32_t& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  int width;
  int height;
  std::vector<std::uint32_t> pixels;
};

struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The bytes of a PNG without time or program name.
Result<std::string> encodePng(const Picture& picture);

}  // namespace toile
