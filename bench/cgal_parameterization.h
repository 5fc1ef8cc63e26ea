// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::bench {

/// CGAL's LSCM parameterisation of a disk, as its users call it: the yardstick of unfolding.
/// Positions per vertex; empty if it fails. Includes making CGAL's own mesh.
std::vector<Eigen::Vector2d> cgalLscm(const Mesh& mesh);

/// CGAL's ARAP parameterisation with its defaults, likewise.
std::vector<Eigen::Vector2d> cgalArap(const Mesh& mesh);

}  // namespace toile::bench
