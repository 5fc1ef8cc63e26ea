// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "unfold/problem.h"
#include "unfold/sparse_factor.h"

namespace toile::unfolding {

/// Two boundary vertices of the outer loop far from each other: what holds a plane still.
[[nodiscard]] std::pair<std::uint32_t, std::uint32_t> farBoundaryPair(
    const Problem& problem, const std::vector<Eigen::Vector3d>& positions);

/// Least squares conformal map at the scale of least strain; it may flip triangles.
/// Nothing if the factorisation fails.
/// @param pins on the axis if the pattern has ties.
/// @see Levy, Petitjean, Ray and Maillot, "Least Squares Conformal Maps", ACM TOG 21(3), 2002.
[[nodiscard]] std::optional<Plane> conformalStart(const Problem& problem,
                                                  const std::vector<Eigen::Vector3d>& positions,
                                                  std::pair<std::uint32_t, std::uint32_t> pins,
                                                  const BlockPattern& pattern,
                                                  SparseFactor& factor);

/// Conformal map whose border has about its target lengths, from three solves with one number per
/// vertex; it may flip triangles. Nothing with holes, or where the border cannot close.
/// @param pattern without ties.
/// @see Sawhney and Crane, "Boundary First Flattening", ACM TOG 37(1), 2017.
[[nodiscard]] std::optional<Plane> boundaryFirstStart(
    const Problem& problem, const BlockPattern& pattern,
    const std::shared_ptr<const Elimination>& elimination);

/// Convex combination map onto a circle, which flips nothing (holes are filled for it).
/// @see Tutte, "How to Draw a Graph", 1963; Floater, "One-to-one Piecewise Linear Mappings over
///   Triangulations", Math. Comp. 72, 2003.
[[nodiscard]] std::optional<Plane> circleStart(const Problem& problem);

/// Scales q about the origin to the size of least symmetric Dirichlet energy.
void scaleToLeastStrain(const Problem& problem, Plane& q);

/// Triangles that are not counter-clockwise (in doubles).
[[nodiscard]] std::size_t flippedCount(const Problem& problem, const Plane& q);

}  // namespace toile::unfolding
