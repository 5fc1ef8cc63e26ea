// SPDX-License-Identifier: GPL-3.0-or-later
// What an order costs: carrying the wetsuit over to another body, and the whole way from a scan to
// files. Limits: transfer with fairing 0.3 s, a whole order 10 s.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "support/yardstick.h"
#include "toile/batch/batch.h"
#include "toile/pipeline.h"
#include "toile/pipeline/carry.h"

namespace toile {
namespace {

const std::filesystem::path kDesign =
    std::filesystem::path(TOILE_SOURCE_DIR) / "tests/designs/wetsuit.toile";

void transferWetsuit(benchmark::State& state, const char* file, bool fair) {
  const Result<Document> own = openDocument(kDesign);
  if (!own) return state.SkipWithError(own.error().message.c_str());
  const auto body = openDocument(kDesign, bench::dataFile(file).string(), FileUnit::Millimetre);
  if (!body) return state.SkipWithError(body.error().message.c_str());
  int bends = 0, bendsCarried = 0;
  for (auto _ : state) {
    const Result<CarriedDesign> carried =
        carryToModel(*own, body->model, {.transfer = {.fair = fair}, .fit = {}});
    if (!carried) return state.SkipWithError(carried.error().message.c_str());
    bends = bendsCarried = 0;
    for (const TransferredCurve& curve : carried->transfer.curves) {
      bends += curve.bendsAfter;
      bendsCarried += curve.bendsCarried;
    }
  }
  state.counters["bends_carried"] = bendsCarried;
  state.counters["bends"] = bends;
}

// Scan in, files out, in a folder that is there afterwards.
void wholeOrder(benchmark::State& state, const char* file) {
  BatchOrder order;
  order.name = "order";
  order.body = bench::dataFile(file).string();
  order.unit = FileUnit::Millimetre;
  const auto out = std::filesystem::temp_directory_path() / "toile-order-bench";
  for (auto _ : state) {
    const Result<OrderOutcome> made = makeOrder(kDesign, order, out);
    if (!made) return state.SkipWithError(made.error().message.c_str());
    if (made->status != "done") return state.SkipWithError(made->reason.c_str());
    state.counters["fit_mean_mm"] = made->fitMean;
  }
  std::filesystem::remove_all(out);
}

BENCHMARK_CAPTURE(transferWetsuit, alike, "bodies/female_tall_slim.ply", true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(transferWetsuit, very_different, "bodies/male_heavy.ply", true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(transferWetsuit, not_faired, "bodies/male_heavy.ply", false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wholeOrder, remesh, "scans/female_average_remesh.ply")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wholeOrder, holes, "scans/male_heavy_holes.ply")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace toile
