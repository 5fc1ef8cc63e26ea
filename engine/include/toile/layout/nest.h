// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/layout/layout.h"

namespace toile {

/// What is to be cut so many times.
struct NestPart {
  std::string name;                      ///< for messages
  std::vector<Eigen::Vector2d> outline;  ///< cut line, counter-clockwise, mm
  double grain = 0;                      ///< radians, direction of the grain in the outline
  Turns turns = Turns::TwoWay;
  int count = 1;     ///< copies as drawn
  int mirrored = 0;  ///< copies turned over: the other half of pairs
  /// Half of a piece, cut on the fold of a cloth that is laid double: the outline's lowest edge,
  /// with the grain to the right, lies on the fold (y = 0 of the material).
  bool onFold = false;
};

/// What it is cut from. x runs along a roll, y across it.
struct NestMaterial {
  double width = 1400;             ///< mm, across
  std::optional<double> length{};  ///< mm, of a sheet; nothing: a roll
  /// A hide instead, counter-clockwise, in the first quadrant; width and length are those of its
  /// box.
  std::vector<Eigen::Vector2d> hide{};
  std::vector<std::vector<Eigen::Vector2d>> faults{};  ///< places to leave out, polygons
};

struct NestOptions {
  double gap = 5;     ///< mm, least distance between cut lines
  double margin = 0;  ///< mm, least distance from the edges of the material
  /// 0: the first fill; each further level about doubles the work. The result depends on nothing
  /// else.
  int effort = 5;
  /// Told of each better marker: its length (of all sheets, mm).
  std::function<void(double)> onBetter{};
};
inline constexpr int kMostEffort = 12;

/// One copy on the material.
struct NestPlace {
  std::uint32_t part = 0;
  bool mirrored = false;  ///< first (x, y) -> (-x, y), then the placement
  std::uint32_t sheet = 0;
  Placement placement;
  [[nodiscard]] Eigen::Vector2d apply(const Eigen::Vector2d& p) const;
};

struct Nesting {
  std::vector<NestPlace> places;  ///< by part, then copy
  double length = 0;              ///< mm used of the roll, or of the last sheet
  std::uint32_t sheets = 1;
  double area = 0;         ///< mm^2, of all copies
  double utilisation = 0;  ///< share of the material up to `length` (of a hide: of all of it)
  double bound = 0;        ///< mm, length that the area alone would need
};

/// Nests parts on a material: a marker.
///
/// Left fill: each copy takes the place that ends farthest to the left, for every allowed turn and
/// every height, between no-fit regions that are computed row by row (rows of a few millimetres
/// that cover the outlines, so that nothing overlaps). The order in which copies are placed is
/// improved by local search. At the end copies are pushed left and down exactly, and the promise
/// is measured on the true lines: apart by the gap, inside, off the faults. The same result for any
/// number of threads.
/// @return InvalidArgument naming a part that does not fit the material (a piece wider than the
///   roll, on a folded cloth, larger than the hide), or one that is no simple polygon; Cancelled.
/// @see Bennell, Oliveira, "The geometry of nesting problems: A tutorial", EJOR 184(2), 2008;
///   Umetani, Murakami, "Coordinate descent heuristics for the irregular strip packing problem of
///   rasterized shapes", EJOR 303(3), 2022, for shapes by rows.
/// @par Cost  bench/nest_bench.cpp
Result<Nesting> nest(std::span<const NestPart> parts, const NestMaterial& material,
                     const NestOptions& options = {}, Progress* progress = nullptr);

}  // namespace toile
