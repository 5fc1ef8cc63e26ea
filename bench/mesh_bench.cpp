// SPDX-License-Identifier: GPL-3.0-or-later
// Reading, and questions to the surface index, on a body of 24k triangles.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>

#include "support/yardstick.h"
#include "toile/mesh/surface_index.h"
#include "toile/model/reference_model.h"

namespace toile {
namespace {

constexpr const char* kBody = "bodies/female_average.ply";
constexpr const char* kLargePatch = "patches/sleeve_100k.obj";

void BM_MeshYardstickFactorisation(benchmark::State& state) {
  if (const auto mesh = bench::loadMesh(state, kBody)) bench::factorise(state, *mesh);
}
BENCHMARK(BM_MeshYardstickFactorisation)->Unit(benchmark::kMillisecond);

void read(benchmark::State& state, const char* file) {
  const std::filesystem::path path = bench::dataFile(file);
  std::size_t faces = 0;
  for (auto _ : state) {
    const Result<MeshFile> mesh = readMesh(path, {.unit = FileUnit::Millimetre});
    if (!mesh) return state.SkipWithError(mesh.error().message.c_str());
    faces = mesh->mesh.faceCount();
  }
  state.counters["faces"] = static_cast<double>(faces);
}

void BM_ReadBody(benchmark::State& state) {
  read(state, kBody);
}
BENCHMARK(BM_ReadBody)->Unit(benchmark::kMillisecond);

void BM_ReadObj100k(benchmark::State& state) {
  read(state, kLargePatch);
}
BENCHMARK(BM_ReadObj100k)->Unit(benchmark::kMillisecond);

void BM_BuildIndex(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  for (auto _ : state) benchmark::DoNotOptimize(SurfaceIndex(mesh));
}
BENCHMARK(BM_BuildIndex)->Unit(benchmark::kMillisecond);

/// Points up to 50 mm off the surface: what projecting and snapping ask for.
std::vector<Eigen::Vector3d> pointsNear(const Mesh& mesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(-50, 50);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 4096; ++i) {
    points.push_back(mesh.position(VertexId(random() % mesh.vertexCount())) +
                     Eigen::Vector3d(offset(random), offset(random), offset(random)));
  }
  return points;
}

void BM_ClosestPoint(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  const SurfaceIndex index(mesh);
  const std::vector<Eigen::Vector3d> points = pointsNear(*mesh);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(index.closestPoint(points[i++ % points.size()]));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_ClosestPoint);

void BM_FirstVisibleHit(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  const SurfaceIndex index(mesh);
  const std::vector<Eigen::Vector3d> points = pointsNear(*mesh);
  const Eigen::Vector3d eye(500, -4000, 1200);
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Vector3d direction = points[i++ % points.size()] - eye;
    benchmark::DoNotOptimize(index.firstVisibleHit(eye, direction));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_FirstVisibleHit);

void BM_PlaneSection(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  const SurfaceIndex index(mesh);
  double height = 100;
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.planeSection({0, 0, 1}, height));
    height = height < 1600 ? height + 1 : 100;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_PlaneSection)->Unit(benchmark::kMicrosecond);

void BM_FindSymmetryPairing(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  for (auto _ : state) {
    benchmark::DoNotOptimize(findSymmetryPairing(*mesh, Eigen::Vector3d::UnitX(), 0, 0.01));
  }
}
BENCHMARK(BM_FindSymmetryPairing)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace toile
