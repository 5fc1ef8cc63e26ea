// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "develop/angle_sums.h"

namespace toile::developing {

/// Areas of the free vertices: a third of their faces. Those that only slivers of a cut meet in
/// count as a share of the mean.
[[nodiscard]] Eigen::VectorXd vertexAreas(const Mesh& mesh, const FreeVertices& free);

/// S: integral of grad u . grad v for functions that are 0 on the vertices that are not free
/// (cotangents, kept between limits on slivers and obtuse pairs).
[[nodiscard]] Eigen::SparseMatrix<double> makeStiffness(const Mesh& mesh, const FreeVertices& free);

/// psi = S^-1 (2 pi - angle sums): the plane whose lengths are exp(-psi) times those of the surface
/// is conformal and keeps the lengths where vertices are not free. > 0 on a bulge, < 0 on a saddle.
[[nodiscard]] VertexData<double> curvaturePotential(const Mesh& mesh, const FreeVertices& free);

/// Area-weighted mean of |exp(-2 psi) - 1|.
[[nodiscard]] double areaErrorOf(const Mesh& mesh, const VertexData<double>& potential);

}  // namespace toile::developing
