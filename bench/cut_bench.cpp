// SPDX-License-Identifier: GPL-3.0-or-later
// Cutting a body of 24k triangles into a network of plane sections.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "support/yardstick.h"
#include "toile/cut/cut.h"
#include "toile/mesh/surface_index.h"

namespace toile {
namespace {

constexpr const char* kBody = "bodies/female_average.ply";

void BM_CutYardstickFactorisation(benchmark::State& state) {
  if (const auto mesh = bench::loadMesh(state, kBody)) bench::factorise(state, *mesh);
}
BENCHMARK(BM_CutYardstickFactorisation)->Unit(benchmark::kMillisecond);

/// The first `count` loops of horizontal and upright sections, which cross each other; every third
/// is a feature.
std::vector<PlacedCurve> sections(const SurfaceIndex& index, std::size_t count) {
  const Eigen::Vector3d low = index.mesh().boxMin();
  const Eigen::Vector3d size = index.mesh().boxMax() - low;
  std::vector<PlacedCurve> curves;
  for (std::size_t i = 0; curves.size() < count; ++i) {
    const double fraction = 0.05 + 0.9 * static_cast<double>((i * 37) % 100) / 100;
    const Eigen::Vector3d normal =
        i % 2 == 0 ? Eigen::Vector3d(0, 0.1, 1) : Eigen::Vector3d(1, 0.2, 0.05);
    const Eigen::Vector3d through = low + fraction * size;
    const std::vector<SurfacePath> loops = index.planeSection(normal, normal.dot(through));
    if (loops.empty()) continue;
    PlacedCurve& curve = curves.emplace_back();
    curve.id = "c" + std::to_string(i);
    curve.kind = i % 3 == 2 ? CurveKind::Feature : CurveKind::Seam;
    curve.path = loops.front();
  }
  return curves;
}

void BM_Refine(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  const auto curves = sections(SurfaceIndex(mesh), static_cast<std::size_t>(state.range(0)));
  std::size_t faces = 0;
  for (auto _ : state) {
    const Result<RefinedMesh> refined = refine(*mesh, curves);
    if (!refined) return state.SkipWithError(refined.error().message.c_str());
    faces = refined->mesh.faceCount();
  }
  state.counters["faces"] = static_cast<double>(faces);
}
BENCHMARK(BM_Refine)->Arg(5)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);

/// The whole step: refining, pieces, wires, mates, findings.
void BM_Cut(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (!mesh) return;
  const auto curves = sections(SurfaceIndex(mesh), static_cast<std::size_t>(state.range(0)));
  auto model = std::make_shared<ReferenceModel>();
  model->mesh = mesh;
  const Document document{std::make_shared<Design>(), model};
  std::size_t pieces = 0;
  for (auto _ : state) {
    const Result<CutResult> result = cut(document, curves);
    if (!result) return state.SkipWithError(result.error().message.c_str());
    pieces = result->pieces.size();
  }
  state.counters["pieces"] = static_cast<double>(pieces);
}
BENCHMARK(BM_Cut)->Arg(5)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace toile
