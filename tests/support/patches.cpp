// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/patches.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

#include "support/meshes.h"

namespace toile::test {

Piece patchOf(const Mesh& mesh, const std::vector<PolygonSoup::Chain>& chains,
              const std::map<std::string, double>& targets) {
  Result<Piece> piece = makePiece("patch", mesh, chains, targets);
  if (!piece) {
    std::cerr << "a piece of a test is broken: " << piece.error().message << '\n';
    std::abort();
  }
  return *std::move(piece);
}

Mesh turnedAnyhow(const Mesh& mesh) {
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, 2, 3).normalized());
  return transformed(mesh, turn.toRotationMatrix(), Eigen::Vector3d(40, -700, 1100));
}

Mesh withoutFace(const Mesh& mesh) {
  std::vector<Triangle> triangles = mesh.triangles();
  triangles.pop_back();
  return *makeMesh(mesh.positions(), triangles);
}

Mesh ring(double inner, double outer, int segments, int rows,
          const std::function<double(double, double)>& height) {
  std::vector<Eigen::Vector3d> positions;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i < segments; ++i) {
      const double radius = inner + (outer - inner) * j / rows;
      const double angle = 2 * std::numbers::pi * i / segments;
      const double x = radius * std::cos(angle), y = radius * std::sin(angle);
      positions.emplace_back(x, y, height(x, y));
    }
  }
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int j) {
    return VertexId(static_cast<std::size_t>(j * segments + i % segments));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < segments; ++i) {
      triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return *makeMesh(positions, triangles);
}

}  // namespace toile::test
