// SPDX-License-Identifier: GPL-3.0-or-later
// From flat pieces to files, on the samples. Yardsticks of the same run: Clipper's own offset of
// the same outlines (for finish), and formatting as many numbers as the DXF holds (for the
// writers).
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <polyclipping/clipper.hpp>
#include <string>

#include "toile/io/dxf.h"
#include "toile/io/pdf.h"
#include "toile/io/svg.h"
#include "toile/pipeline.h"

namespace {

using namespace toile;

const char* const kSamples[] = {"bent-sleeve", "torso-vest"};

/// The pattern of a sample, made once; empty where it cannot be made.
const Pattern& samplePattern(benchmark::State& state) {
  static std::map<std::string, Pattern> patterns;
  const std::string name = kSamples[state.range(0)];
  state.SetLabel(name);
  const auto found = patterns.find(name);
  if (found != patterns.end()) return found->second;
  Pattern pattern;
  const auto document = openDocument(TOILE_SOURCE_DIR "/examples/" + name + ".toile");
  if (document) {
    if (auto made = makePattern(*document)) pattern = *std::move(made);
  }
  if (pattern.pieces.empty()) state.SkipWithError("the sample has no pieces");
  return patterns.emplace(name, std::move(pattern)).first->second;
}

std::size_t outlinePoints(const Pattern& pattern) {
  std::size_t points = 0;
  for (const PatternPiece& piece : pattern.pieces)
    for (const Outline& line : piece.sewLines) points += line.size();
  return points;
}

void BM_Finish(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(finish(pattern.document, pattern.curves, pattern.cut, pattern.flats));
  state.counters["outline_points"] = static_cast<double>(outlinePoints(pattern));
}

void BM_FinishYardstickClipperOffset(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  for (auto _ : state) {
    for (const PatternPiece& piece : pattern.pieces) {
      ClipperLib::ClipperOffset offset;
      for (const Outline& line : piece.sewLines) {
        ClipperLib::Path path;
        for (const OutlinePoint& p : line)
          path.emplace_back(static_cast<ClipperLib::cInt>(p.position.x() * 1e5),
                            static_cast<ClipperLib::cInt>(p.position.y() * 1e5));
        offset.AddPath(path, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
      }
      ClipperLib::Paths result;
      offset.Execute(result, 10 * 1e5);
      benchmark::DoNotOptimize(result);
    }
  }
}

void BM_Arrange(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(arrange(*pattern.document.model, pattern.cut, pattern.flats,
                                     pattern.pieces, pattern.pieceIndex));
  state.counters["pieces"] = static_cast<double>(pattern.pieces.size());
}

void BM_WriteDxf(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  std::size_t size = 0;
  for (auto _ : state) size = writeDxf(pattern).text.size();
  state.SetBytesProcessed(static_cast<std::int64_t>(size) * state.iterations());
}

void BM_WriteSvg(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  std::size_t size = 0;
  for (auto _ : state) size = writeSvg(drawSheet(pattern)).size();
  state.SetBytesProcessed(static_cast<std::int64_t>(size) * state.iterations());
}

void BM_WritePdf(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  std::size_t size = 0;
  for (auto _ : state) {
    if (const auto pdf = writePdf(drawSheet(pattern))) size = pdf->size();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(size) * state.iterations());
}

void BM_WriteYardstickFormatNumbers(benchmark::State& state) {
  const Pattern& pattern = samplePattern(state);
  const std::string dxf = writeDxf(pattern).text;
  const auto numbers = std::count(dxf.begin(), dxf.end(), '.');
  for (auto _ : state) {
    std::string text;
    for (std::ptrdiff_t i = 0; i < numbers; ++i)
      fmt::format_to(std::back_inserter(text), "{:.3f}\r\n", 0.37 * static_cast<double>(i));
    benchmark::DoNotOptimize(text);
  }
}

#define TOILE_ON_SAMPLES(name) BENCHMARK(name)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)
TOILE_ON_SAMPLES(BM_Finish);
TOILE_ON_SAMPLES(BM_FinishYardstickClipperOffset);
TOILE_ON_SAMPLES(BM_Arrange);
TOILE_ON_SAMPLES(BM_WriteDxf);
TOILE_ON_SAMPLES(BM_WriteSvg);
TOILE_ON_SAMPLES(BM_WritePdf);
TOILE_ON_SAMPLES(BM_WriteYardstickFormatNumbers);

}  // namespace
