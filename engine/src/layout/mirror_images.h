// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "layout/placed_piece.h"

namespace toile {

/// The rigid motion, near none, that brings `moving` onto `still`, and how far lines then are
/// apart.
struct Alignment {
  Placement motion;
  double distance = 0;  ///< mm, greatest
};
/// By Gauss-Newton steps on the distances of points to lines.
[[nodiscard]] Alignment align(const Points2& moving, const Points2& still);

/// Lines that come this close all along are the same line, mm.
inline constexpr double kSameLineMm = 0.05;

/// For each piece the one that mirrors it at x = 0 (itself where it lies across the axis), or none.
///
/// Mirrored pieces are made so exactly: what their unfolding left of a difference is taken out of
/// the second one's placement, and the lines that overlaps are decided by are copied mirrored.
std::vector<std::optional<std::size_t>> makeMirrored(std::vector<PlacedPiece>& placed);

}  // namespace toile
