// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/finish/pattern_piece.h"
#include "toile/model/guiding_map.h"

namespace toile {

/// Rigid motion of a pattern piece on the sheet: p -> R(angle) p + offset; never a mirror image.
struct Placement {
  double angle = 0;                                  ///< radians, counter-clockwise
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< mm
  [[nodiscard]] Eigen::Vector2d apply(const Eigen::Vector2d& p) const;
  [[nodiscard]] Eigen::Vector2d applyToDirection(const Eigen::Vector2d& d) const;
};

struct Layout {
  std::vector<Placement> placements;  ///< per pattern piece
  /// Per pattern piece its side of the guiding map and its place there, before pieces were moved
  /// apart.
  std::vector<MapSide> side;
  std::vector<Placement> onMap;
  /// Per pattern piece its place on the map by least squares alone: what a hand moves it from.
  std::vector<Placement> beforeHands;
  /// Where the origin of the map's front and back lie on the sheet.
  std::array<Eigen::Vector2d, 2> mapOrigin{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  Eigen::Vector2d min = Eigen::Vector2d::Zero();  ///< box of all cut lines, mm
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
  std::vector<Finding> findings;
};

/// What a hand does to bring a piece to a place on the sheet: arrange() puts it there, but for
/// where the sheet begins.
/// @param layout by arrange()
/// @param index of the pattern piece
[[nodiscard]] HandPlacement placedByHand(const Layout& layout, const PatternPiece& piece,
                                         std::size_t index, const Placement& wanted);

inline constexpr double kLayoutGapMm = 10;  ///< least distance between cut lines

/// Places pieces as on the body, left and right in their places, without overlaps.
///
/// Each piece is brought to its places on the guiding map by the rigid motion of least squares, by
/// area, counting only the chart that holds most of it. Then the article's rule parts them: from
/// the lowest on, sorted by the bottom edge and then from the axis outwards, each that overlaps
/// what is fixed moves outwards (the left group to the left) or up, whichever is shorter, and what
/// is still free in its group moves along. Pieces across the axis move up alone. The front of the
/// map lies beside the back. Overlap is decided on the outlines themselves.
///
/// Pieces that mirror each other about the axis are moved together, so that a symmetric design
/// lies on the sheet exactly symmetric. Pieces placed by hand are fixed from the start.
/// @param pieceIndex per pattern piece its index in `cut.pieces` and in `flats`.
/// @param byHand the design's `layout`; two pieces that overlap there are left so, with a finding.
/// @par Cost  bench/output_bench.cpp
Result<Layout> arrange(const ReferenceModel& model, const CutResult& cut,
                       const std::vector<std::shared_ptr<const FlatPiece>>& flats,
                       const std::vector<PatternPiece>& pattern,
                       const std::vector<std::uint32_t>& pieceIndex,
                       const std::vector<HandPlacement>& byHand = {});

}  // namespace toile
