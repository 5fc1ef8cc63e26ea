// SPDX-License-Identifier: GPL-3.0-or-later
// What a customer's scan takes from file contents to the fitted template.
#include <benchmark/benchmark.h>

#include "support/yardstick.h"
#include "toile/body/fit_body.h"
#include "toile/fit/fit.h"

namespace toile {
namespace {

void BM_FitYardstick(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, "bodies/male_average.ply");
  if (mesh) bench::factorise(state, *mesh);
}
BENCHMARK(BM_FitYardstick)->Unit(benchmark::kMillisecond);

/// 24k triangles to 126k without noise, family of four.
void BM_FitBodyTemplate(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, "bodies/male_average.ply");
  const Result<Scan> scan =
      readScan(bench::dataFile("scans/female_average_remesh.ply"), FileUnit::Millimetre);
  if (!mesh || !scan) return state.SkipWithError("no test data");
  FitOptions options;
  for (const char* name : {"female_tall_slim", "male_heavy", "child_10y", "elderly"}) {
    options.family.push_back(bench::loadMesh(state, "bodies/" + std::string(name) + ".ply"));
  }
  const ReferenceModel model = makeReferenceModel("template", *mesh);
  double distance = 0;
  for (auto _ : state) {
    const Result<Fit> fit = fitTemplate(model, *scan, options);
    if (!fit) return state.SkipWithError(fit.error().message.c_str());
    distance = fit->report.scanToFit.mean;
  }
  state.counters["scan_to_fit_mm"] = distance;
}
BENCHMARK(BM_FitBodyTemplate)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// The parametric body to a scan with holes and noise, both fits.
void BM_FitParametricBody(benchmark::State& state) {
  const Result<Scan> scan =
      readScan(bench::dataFile("scans/male_heavy_holes.ply"), FileUnit::Millimetre);
  if (!scan) return state.SkipWithError("no test data");
  for (auto _ : state) {
    const Result<BodyFit> fit = fitBody(*scan);
    if (!fit) return state.SkipWithError(fit.error().message.c_str());
  }
}
BENCHMARK(BM_FitParametricBody)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace toile
