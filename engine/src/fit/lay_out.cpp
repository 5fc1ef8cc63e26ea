// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/lay_out.h"

#include <Eigen/SparseCholesky>

namespace toile::fitting {

void layOut(const Mesh& connectivity, const std::vector<Eigen::Vector3d>& shape,
            const std::vector<Eigen::Matrix3d>& linear, const std::vector<char>& isFree,
            std::vector<Eigen::Vector3d>& positions) {
  std::vector<Eigen::Index> number(positions.size(), -1);
  Eigen::Index count = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (isFree[v] != 0) number[v] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  for (std::size_t e = 0; e < connectivity.edgeCount(); ++e) {
    const std::size_t a = connectivity.tail(EdgeId(e)).index();
    const std::size_t b = connectivity.head(EdgeId(e)).index();
    const Eigen::Vector3d wanted = 0.5 * (linear[a] + linear[b]) * (shape[b] - shape[a]);
    const auto add = [&](std::size_t own, std::size_t other, const Eigen::Vector3d& away) {
      if (number[own] < 0) return;
      entries.emplace_back(number[own], number[own], 1.0);
      right.row(number[own]) += away.transpose();
      if (number[other] < 0) {
        right.row(number[own]) += positions[other].transpose();
      } else {
        entries.emplace_back(number[own], number[other], -1.0);
      }
    };
    add(a, b, -wanted);
    add(b, a, wanted);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return;
  const Eigen::MatrixX3d solution = solver.solve(right);
  if (!solution.allFinite()) return;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (number[v] >= 0) positions[v] = solution.row(number[v]).transpose();
  }
}

}  // namespace toile::fitting
