// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/layout/pattern.h"

namespace toile {

struct RenderOptions {
  int width = 1600;   ///< px, 16..16000
  int height = 1000;  ///< px, 16..16000
  int samples = 2;    ///< per pixel and axis
};

/// A picture of the model with its lines and piece colours, front and back, the flat pieces beside
/// it; ray traced without a display. Same pixels for any number of threads.
/// @return the bytes of a PNG.
Result<std::string> renderPreview(const Pattern& pattern, const RenderOptions& options = {});

}  // namespace toile
