// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace toile {

/// A block of text that may be set: its box at type size 1.
struct LabelBlock {
  double width = 1, height = 1;
  double worth = 1;  ///< factor on the size it is worth: less for broken lines
};

struct LabelRoom {
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< px, closed; y down
  std::vector<std::vector<Eigen::Vector2d>> lines;     ///< px, better not covered
  Eigen::Vector2d wish = Eigen::Vector2d::Zero();      ///< px, a good place for the middle
};

struct LabelPlace {
  std::size_t block = 0;
  double size = 0;  ///< of type, px
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double angle = 0;  ///< radians, clockwise on the screen, -pi/2..pi/2
};

/// Where one of the blocks stands largest within the outlines: level, upright or along the piece.
/// Beyond `mostSize` larger is no better.
/// @return nothing when none fits at `leastSize`
[[nodiscard]] std::optional<LabelPlace> fitLabel(const LabelRoom& room,
                                                 std::span<const LabelBlock> blocks,
                                                 double mostSize, double leastSize);

}  // namespace toile
