// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/untangle.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "fit/surface.h"

namespace toile::fitting {
namespace {

constexpr int kTrials = 5;

/// The edges' vectors as expected, in the least squares sense, for the vertices marked.
void layOut(const Mesh& mesh, const Expectation& expected, const std::vector<char>& isMarked,
            std::vector<Eigen::Vector3d>& positions) {
  std::vector<Eigen::Index> number(positions.size(), -1);
  Eigen::Index count = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (isMarked[v] != 0) number[v] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const std::size_t a = mesh.tail(EdgeId(e)).index();
    const std::size_t b = mesh.head(EdgeId(e)).index();
    const Eigen::Vector3d wanted =
        0.5 * (expected.linear[a] + expected.linear[b]) * (expected.shape[b] - expected.shape[a]);
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

}  // namespace

std::vector<FaceId> turnedFaces(const Mesh& connectivity,
                                const std::vector<Eigen::Vector3d>& positions,
                                const Expectation& expected) {
  std::vector<FaceId> turned;
  for (std::size_t f = 0; f < connectivity.faceCount(); ++f) {
    const Eigen::Vector3d cross = faceCross(positions, connectivity.vertices(FaceId(f)));
    if (cross.dot(expected.normals[f]) <= 0) turned.emplace_back(f);
  }
  return turned;
}

void untangle(const Mesh& connectivity, const Expectation& expected,
              std::vector<Eigen::Vector3d>& positions) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<FaceId> turned = turnedFaces(connectivity, positions, expected);
    if (turned.empty()) return;
    std::vector<char> isMarked(positions.size(), 0);
    for (const FaceId face : turned) {
      for (const VertexId v : connectivity.vertices(face)) isMarked[v.index()] = 1;
    }
    for (int ring = 0; ring < 1 + trial; ++ring) {
      std::vector<char> wider = isMarked;
      for (const Triangle& t : connectivity.triangles()) {
        if (std::none_of(t.begin(), t.end(),
                         [&](VertexId v) { return isMarked[v.index()] != 0; })) {
          continue;
        }
        for (const VertexId v : t) wider[v.index()] = 1;
      }
      isMarked = std::move(wider);
    }
    // With nothing left to hang on there is no place for it.
    if (std::all_of(isMarked.begin(), isMarked.end(), [](char m) { return m != 0; })) return;
    layOut(connectivity, expected, isMarked, positions);
  }
}

}  // namespace toile::fitting
