// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace toile::detail {

/// Larger ones are refused by the reader: the work grows with the square.
inline constexpr std::size_t kMaxPolygonCorners = 10'000;

struct PolygonTriangles {
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< places in the polygon
  bool isSimple = true;  ///< false: it crosses itself or has no area, the triangles are a guess
};

/// Triangulates a polygon in space, seen along its mean (Newell) normal, without new vertices. A
/// strictly convex one becomes the fan from its first corner; otherwise ears are cut off, always
/// the one with the largest least angle.
[[nodiscard]] PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> polygon);

}  // namespace toile::detail
