// SPDX-License-Identifier: GPL-3.0-or-later
// What the hand waits for when a point of a line is moved: the front seam of the wetsuit of
// tests/designs at the bust, on a scanned-like body of 24k triangles, line and mirrored line. Each
// round moves the point by 0.4 mm. "All" makes the pattern without memory, for comparison.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "support/yardstick.h"
#include "toile/pipeline/live_pattern.h"

namespace toile {
namespace {

std::optional<Document> open(benchmark::State& state) {
  const Result<Document> document =
      openDocument(std::filesystem::path(TOILE_SOURCE_DIR) / "tests/designs/wetsuit.toile",
                   bench::dataFile("bodies/female_average.ply").string(), FileUnit::Millimetre);
  if (document) return *document;
  state.SkipWithError(document.error().message.c_str());
  return std::nullopt;
}

/// The document with the front seam's point at the bust moved.
Document moved(const Document& document, int step) {
  Design design = *document.design;
  for (StylingCurve& curve : design.curves) {
    if (curve.id != "princess-front-l") continue;
    auto& way = std::get<SmoothWay>(curve.way);
    std::get<OnStylingCurve>(way.controls[2]).fraction = 0.13 + 0.002 * (step % 20);
  }
  return {std::make_shared<const Design>(std::move(design)), document.model};
}

void update(benchmark::State& state, Quality quality) {
  const auto document = open(state);
  if (!document) return;
  LivePattern live;
  if (!live.update(*document, Quality::Full)) return state.SkipWithError("no pattern");
  int step = 0;
  std::size_t touched = 0;
  double areaError = 0;  // faster but worse must show
  for (auto _ : state) {
    const Result<LiveAnswer> answer = live.update(moved(*document, ++step), quality);
    if (!answer) return state.SkipWithError(answer.error().message.c_str());
    touched = 0;
    areaError = 0;
    for (std::size_t i = 0; i < answer->pieces.size(); ++i) {
      const auto& flat = answer->pattern.flats[i];
      if (!flat || answer->pieces[i].isReused) continue;
      ++touched;
      areaError = std::max(areaError, flat->meanAreaError);
    }
  }
  state.counters["touched"] = static_cast<double>(touched);
  state.counters["worst_area_error"] = areaError;
}

void preview(benchmark::State& state) {
  update(state, Quality::Preview);
}
/// The point comes back to twenty places, of which the solved pieces would be known: so that every
/// round solves, the memory is made anew every twenty rounds.
void full(benchmark::State& state) {
  const auto document = open(state);
  if (!document) return;
  auto live = std::make_unique<LivePattern>();
  int step = 0;
  for (auto _ : state) {
    if (step++ % 19 == 0) {
      state.PauseTiming();
      live = std::make_unique<LivePattern>();
      benchmark::DoNotOptimize(live->update(*document, Quality::Full));
      step = 1;
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(live->update(moved(*document, step), Quality::Full));
  }
}
void all(benchmark::State& state) {
  const auto document = open(state);
  if (!document) return;
  int step = 0;
  for (auto _ : state) benchmark::DoNotOptimize(makePattern(moved(*document, ++step)));
}

BENCHMARK(preview)->Name("BM_Live/Preview")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(full)->Name("BM_Live/Full")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(all)->Name("BM_Live/All")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace toile
