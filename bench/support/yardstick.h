// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "toile/mesh/mesh_file.h"

/// What benchmarks share. Times mean something only beside a yardstick of the same run: one CHOLMOD
/// factorisation of the cotangent Laplacian of the same mesh.
namespace toile::bench {

/// The shared test data: TOILE_TEST_DATA, else ../shared/data beside the tree.
inline std::filesystem::path dataFile(const std::string& relative) {
  const char* folder = std::getenv("TOILE_TEST_DATA");
  return (folder != nullptr ? std::filesystem::path(folder)
                            : std::filesystem::path(TOILE_SOURCE_DIR) / "../shared/data") /
         relative;
}

/// The mesh of a file of the test data; null where it is absent, after telling the state.
inline std::shared_ptr<const Mesh> loadMesh(benchmark::State& state, const std::string& relative) {
  Result<MeshFile> file = readMesh(dataFile(relative), {.unit = FileUnit::Millimetre});
  if (file) return std::make_shared<const Mesh>(std::move(file->mesh));
  state.SkipWithError(file.error().message.c_str());
  return nullptr;
}

/// Cotangent Laplacian plus a little mass, so that it is definite.
inline Eigen::SparseMatrix<double> cotangentLaplacian(const Mesh& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * mesh.faceCount() + mesh.vertexCount());
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = t[k];
      const VertexId b = t[(k + 1) % 3];
      const Eigen::Vector3d u = mesh.position(a) - mesh.position(t[(k + 2) % 3]);
      const Eigen::Vector3d v = mesh.position(b) - mesh.position(t[(k + 2) % 3]);
      const double weight = 0.5 * u.dot(v) / u.cross(v).norm();
      const int i = static_cast<int>(a.index());
      const int j = static_cast<int>(b.index());
      entries.emplace_back(i, i, weight);
      entries.emplace_back(j, j, weight);
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(j, i, -weight);
    }
  }
  const auto size = static_cast<Eigen::Index>(mesh.vertexCount());
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 1e-3);
  Eigen::SparseMatrix<double> laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

/// The yardstick: analysis and numeric factorisation.
inline void factorise(benchmark::State& state, const Mesh& mesh) {
  const Eigen::SparseMatrix<double> laplacian = cotangentLaplacian(mesh);
  for (auto _ : state) {
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> solver(laplacian);
    if (solver.info() != Eigen::Success) state.SkipWithError("not definite");
    benchmark::DoNotOptimize(solver);
  }
}

}  // namespace toile::bench
