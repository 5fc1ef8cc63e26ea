// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::fitting {

/// The cotangent Laplacian (stiffness matrix) of a surface: its lower triangle, with weights that
/// are at least a little positive.
[[nodiscard]] Eigen::SparseMatrix<double> cotangentLaplacian(
    const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions);

}  // namespace toile::fitting
