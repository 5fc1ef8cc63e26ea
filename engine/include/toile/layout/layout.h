// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/finish/pattern_piece.h"

namespace toile {

/// Rigid motion of a pattern piece on the sheet: p -> R(angle) p + offset; never a mirror image.
struct Placement {
  double angle = 0;                                  ///< radians, counter-clockwise
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< mm
  [[nodiscard]] Eigen::Vector2d apply(const Eigen::Vector2d& p) const;
  [[nodiscard]] Eigen::Vector2d applyToDirection(const Eigen::Vector2d& d) const;
};

struct Layout {
  std::vector<Placement> placements;              ///< per pattern piece
  Eigen::Vector2d min = Eigen::Vector2d::Zero();  ///< box of all cut lines, mm
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
  std::vector<Finding> findings;
};

inline constexpr double kLayoutGapMm = 10;  ///< least distance between cut lines

/// Places pieces upright as on the body, left and right in their places, without overlaps.
///
/// The guiding map is the model seen from the front (the wearer's right on the left of the sheet)
/// beside the model seen from behind; each piece goes to the chart that its surface faces, by least
/// squares over its surface, then pieces are moved outwards or up until cut lines keep their gap
/// (section 6 of the article's layout; exact polygon test). A mirrored pair stays mirrored.
/// @param pieceIndex per pattern piece its index in `cut.pieces` and in `flats`.
Result<Layout> arrange(const ReferenceModel& model, const CutResult& cut,
                       const std::vector<std::shared_ptr<const FlatPiece>>& flats,
                       const std::vector<PatternPiece>& pattern,
                       const std::vector<std::uint32_t>& pieceIndex);

}  // namespace toile
