// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "toile/unfold/unfold.h"
#include "unfold/problem.h"

namespace toile::unfolding {

/// Wire edges that overlap by less than this touch, they do not cross: the two sides of a dart
/// without intake lie on each other. No cutter sees it.
inline constexpr double kContactDepthMm = 1e-3;

/// Pairs of wire edges (indices in Problem::wireEdges) that cross without sharing a node,
/// ascending; edges of the boundary that pass through each other at a vertex too. Exact predicates;
/// found by a grid, so the cost is about linear.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> findCrossings(
    const Problem& problem, const Plane& q);

/// Triangles that are not counter-clockwise, by exact predicates, ascending.
[[nodiscard]] std::vector<std::uint32_t> findFlips(const Problem& problem, const Plane& q);

/// Everything of UnfoldCheck but the two lists above, whose sizes it takes.
[[nodiscard]] UnfoldCheck makeCheck(const Problem& problem, const Plane& q, std::size_t flips,
                                    std::size_t crossings);

/// Stretches of every face.
[[nodiscard]] FaceData<FaceDistortion> computeDistortion(const Problem& problem, const Plane& q);

/// Turns the plane so that the model's z points up on average, and moves its centroid to 0. A
/// symmetric one, whose axis is x = 0, keeps its axis on a coordinate axis.
void place(const Problem& problem, const std::vector<Eigen::Vector3d>& positions, bool isSymmetric,
           Plane& q);

}  // namespace toile::unfolding
