// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace toile::detail {

/// A connected part of a surface that is to be flattened.
struct ConformalPatch {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// For every vertex its mirror partner (itself on the mid-line); empty: none.
  std::vector<std::uint32_t> partner;
  /// A rough picture of it in the plane, which the iteration starts from; mirrored at x = 0.
  std::vector<Eigen::Vector2d> start;
};

/// Least squares conformal map with unit mass on the border in place of pinned vertices. With
/// partners the result is mirrored at x = 0 bit for bit. Its scale and, without partners, its turn
/// mean nothing. @return empty where the numbers give out
[[nodiscard]] std::vector<Eigen::Vector2d> conformalMap(const ConformalPatch& patch);

}  // namespace toile::detail
