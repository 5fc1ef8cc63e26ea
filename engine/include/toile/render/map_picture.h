// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/layout/pattern.h"

namespace toile {

enum class PictureFormat { Png, Svg };

struct MapPictureOptions {
  PictureFormat format = PictureFormat::Png;
  int width = 1600;  ///< px, 64 to 20000
  int height = 1000;
};

/// The guiding map of a model: its charts, front beside back, with the model's curves on them. A
/// PNG shows the relief of the surface too.
/// @return InvalidArgument for a size out of range
Result<std::string> drawGuidingMap(const ReferenceModel& model,
                                   const MapPictureOptions& options = {});

/// How a layout comes about (the article's figure 6): the map, the pieces on their places on it,
/// the pieces moved apart; all three on one scale.
Result<std::string> drawMapLayout(const Pattern& pattern, const MapPictureOptions& options = {});

}  // namespace toile
