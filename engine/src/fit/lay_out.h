// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::fitting {

/// Moves the free vertices so that every edge comes as near as it can, in the least squares sense,
/// to that of `shape` under the mean of `linear` at its ends; the others keep their places, and at
/// least one of them is needed.
/// @see Sorkine and Alexa, "As-Rigid-As-Possible Surface Modeling", SGP 2007: its global step.
void layOut(const Mesh& connectivity, const std::vector<Eigen::Vector3d>& shape,
            const std::vector<Eigen::Matrix3d>& linear, const std::vector<char>& isFree,
            std::vector<Eigen::Vector3d>& positions);

}  // namespace toile::fitting
