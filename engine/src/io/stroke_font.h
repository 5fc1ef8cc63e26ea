// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "finish/polygon.h"

namespace toile {

/// A line of text as pen strokes, for machines that know no letters: capitals, digits and a few
/// signs; other letters are spelled in ASCII, lower case is drawn as capitals.
/// @param middle of the baseline
/// @param height of capitals, mm
[[nodiscard]] std::vector<Points2> strokeText(const std::string& utf8,
                                              const Eigen::Vector2d& middle, double height,
                                              double angle);

/// Width of that text over the height of its capitals.
[[nodiscard]] double strokeTextWidth(const std::string& utf8);

}  // namespace toile
