// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace toile {

enum class SubdivisionRule {
  Auto,        ///< Uniform, or Centripetal where neighbouring spans differ by more than 3 times
  Uniform,     ///< the article's: (-1, 9, 9, -1) / 16
  Centripetal  ///< cubic through four neighbours with knots |p(i+1) - p(i)|^0.5
};

inline constexpr int kSubdivisionRounds = 3;

/// 4-point subdivision: interpolates the control points; n open ones become 2^rounds (n-1) + 1
/// points, n closed ones 2^rounds n. Two open points give a straight row. At an open end the
/// uniform rule reflects the second point in the first; the centripetal one uses the cubic through
/// the first four points (quadratic through three). The reversed row gives the reversed curve bit
/// for bit.
///
/// @param points at least 2 (open) or 3 (closed), neighbours different. Dimension 2 (view plane)
/// or 3.
/// @see Dyn, Levin, Gregory, "A 4-point interpolatory subdivision scheme", CAGD 4, 1987; Dyn,
/// Floater, Hormann, "Four-point curve subdivision based on iterated chordal and centripetal
/// parameterizations", CAGD 26, 2009.
template <int Dimension>
std::vector<Eigen::Matrix<double, Dimension, 1>> subdivide(
    std::span<const Eigen::Matrix<double, Dimension, 1>> points, bool closed,
    SubdivisionRule rule = SubdivisionRule::Auto, int rounds = kSubdivisionRounds);

/// The same with sharp corners: at these control points (indices, ascending) the curve breaks off
/// and begins anew. An index at an open end changes nothing.
template <int Dimension>
std::vector<Eigen::Matrix<double, Dimension, 1>> subdivideWithCorners(
    std::span<const Eigen::Matrix<double, Dimension, 1>> points, bool closed,
    std::span<const std::size_t> corners, SubdivisionRule rule = SubdivisionRule::Auto,
    int rounds = kSubdivisionRounds);

extern template std::vector<Eigen::Vector2d> subdivide<2>(std::span<const Eigen::Vector2d>, bool,
                                                          SubdivisionRule, int);
extern template std::vector<Eigen::Vector3d> subdivide<3>(std::span<const Eigen::Vector3d>, bool,
                                                          SubdivisionRule, int);

extern template std::vector<Eigen::Vector2d> subdivideWithCorners<2>(
    std::span<const Eigen::Vector2d>, bool, std::span<const std::size_t>, SubdivisionRule, int);
extern template std::vector<Eigen::Vector3d> subdivideWithCorners<3>(
    std::span<const Eigen::Vector3d>, bool, std::span<const std::size_t>, SubdivisionRule, int);

}  // namespace toile
