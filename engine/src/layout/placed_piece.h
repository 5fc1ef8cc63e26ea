// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "finish/polygon.h"
#include "toile/layout/layout.h"
#include "toile/model/guiding_map.h"

namespace toile {

/// The rigid motion p -> R(angle) p + offset, first `first`, then `second`.
[[nodiscard]] Placement composed(const Placement& second, const Placement& first);
[[nodiscard]] Placement inverse(const Placement& placement);

/// A pattern piece on its side of the map; the medial axis is x = 0.
struct PlacedPiece {
  std::size_t piece = 0;  ///< index in the pattern
  MapSide side = MapSide::Front;
  Placement placement;
  Points2 cut;          ///< cut line in place
  Points2 grownBy;      ///< the same grown by half the gap: grown lines may touch, not overlap
  bool byHand = false;  ///< stays where it is
  void move(const Placement& by);
  void shift(const Eigen::Vector2d& by);
};

/// Where the least squares rigid motion puts a flat piece on the map: its points against their
/// places, by their share of the area, on the chart that holds most of it. Points on other charts
/// do not count. The motion never mirrors.
struct PlaceOnMap {
  std::uint32_t chart = 0;
  Placement placement;
};
[[nodiscard]] PlaceOnMap placeOnMap(const Piece& piece, const FlatPiece& flat, const Mesh& model,
                                    const GuidingMap& map);

}  // namespace toile
