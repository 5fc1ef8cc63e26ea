// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::test {

/// As-rigid-as-possible plane of a surface, no length kept: what cloth would be without wires.
/// @param start a plane without folds.
/// @see Liu, Zhang, Xu, Gotsman and Gortler, "A Local/Global Approach to Mesh Parameterization",
///   Computer Graphics Forum 27(5), 2008.
std::vector<Eigen::Vector2d> arapPlane(const Mesh& mesh, std::vector<Eigen::Vector2d> start);

/// Area-weighted mean of |A2/A3 - 1|.
double meanAreaError(const Mesh& mesh, const std::vector<Eigen::Vector2d>& plane);

/// Mean over the edges of |l2/l3 - 1|, weighted by l3.
double meanLengthError(const Mesh& mesh, const std::vector<Eigen::Vector2d>& plane);

}  // namespace toile::test
