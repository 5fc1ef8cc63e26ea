// SPDX-License-Identifier: GPL-3.0-or-later
// The guiding map of bodies whose hands have fingers, 24k and 98k triangles. Yardstick of the same
// run: one CHOLMOD factorisation of the cotangent Laplacian of the mesh.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "support/yardstick.h"
#include "toile/model/guiding_map.h"

namespace toile {
namespace {

constexpr std::array kBodies = {"bodies/female_average.ply", "bodies/female_average_fine.ply"};

void BM_GuidingMapYardstickFactorisation(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBodies.at(static_cast<std::size_t>(state.range(0))));
  if (mesh) bench::factorise(state, *mesh);
}
BENCHMARK(BM_GuidingMapYardstickFactorisation)->DenseRange(0, 1)->Unit(benchmark::kMillisecond);

void BM_GuidingMap(benchmark::State& state) {
  const std::string name = kBodies.at(static_cast<std::size_t>(state.range(0)));
  const Result<ReferenceModel> model = readModel(bench::dataFile(name), FileUnit::Millimetre);
  if (!model) return state.SkipWithError(model.error().message.c_str());
  std::size_t charts = 0;
  for (auto _ : state) charts = makeGuidingMap(*model).charts.size();
  state.counters["faces"] = static_cast<double>(model->mesh->faceCount());
  state.counters["charts"] = static_cast<double>(charts);
}
BENCHMARK(BM_GuidingMap)->DenseRange(0, 1)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace toile
