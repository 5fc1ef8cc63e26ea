// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way from a document to files, and where its time goes: on the vest of the examples and
// on the wetsuit of tests/designs for a scanned-like body. "Yardstick" is one sparse factorisation
// of the same mesh; the article this program follows needed less than a minute for such a suit.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "support/yardstick.h"
#include "toile/io/dxf.h"
#include "toile/io/pdf.h"
#include "toile/io/report.h"
#include "toile/io/svg.h"
#include "toile/pipeline.h"
#include "toile/render/render.h"

namespace toile {
namespace {

struct Shape {
  const char* design;  ///< below the source tree
  const char* body;    ///< below the test data; null: the design's own model
};
constexpr Shape kVest{"examples/torso-vest.toile", nullptr};
constexpr Shape kWetsuit{"tests/designs/wetsuit.toile", "bodies/female_average.ply"};

std::optional<Document> open(benchmark::State& state, const Shape& shape) {
  std::optional<std::string> body;
  if (shape.body != nullptr) body = bench::dataFile(shape.body).string();
  const Result<Document> document = openDocument(
      std::filesystem::path(TOILE_SOURCE_DIR) / shape.design, body, FileUnit::Millimetre);
  if (document) return *document;
  state.SkipWithError(document.error().message.c_str());
  return std::nullopt;
}

/// The made pattern that benchmarks of single steps begin with.
std::optional<Pattern> make(benchmark::State& state, const Shape& shape) {
  const std::optional<Document> document = open(state, shape);
  if (!document) return std::nullopt;
  Result<Pattern> pattern = makePattern(*document);
  if (pattern) return std::move(*pattern);
  state.SkipWithError(pattern.error().message.c_str());
  return std::nullopt;
}

void yardstick(benchmark::State& state, const Shape& shape) {
  if (const auto document = open(state, shape)) bench::factorise(state, *document->model->mesh);
}

void openTheDocument(benchmark::State& state, const Shape& shape) {
  for (auto _ : state) benchmark::DoNotOptimize(open(state, shape));
}

void place(benchmark::State& state, const Shape& shape) {
  const auto document = open(state, shape);
  if (!document) return;
  for (auto _ : state) {
    benchmark::DoNotOptimize(placeCurves(*document->design, *document->model));
  }
}

void cutAll(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  for (auto _ : state) benchmark::DoNotOptimize(cut(pattern->document, pattern->curves));
}

void unfoldAll(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  std::size_t faces = 0;
  int steps = 0;
  double areaError = 0;  // faster but worse must show
  for (auto _ : state) {
    faces = 0;
    steps = 0;
    areaError = 0;
    for (const Piece& piece : pattern->cut.pieces) {
      if (!piece.include) continue;
      const Result<FlatPiece> flat = unfold(piece);
      if (!flat) return state.SkipWithError(flat.error().message.c_str());
      faces += piece.mesh->faceCount();
      steps += flat->steps;
      areaError += flat->meanAreaError * static_cast<double>(piece.mesh->faceCount());
    }
  }
  state.counters["faces"] = static_cast<double>(faces);
  state.counters["steps"] = steps;
  state.counters["area_error"] = areaError / static_cast<double>(faces);
}

void finishAll(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        finish(pattern->document, pattern->curves, pattern->cut, pattern->flats));
  }
}

void arrangeAll(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  for (auto _ : state) {
    benchmark::DoNotOptimize(arrange(*pattern->document.model, pattern->cut, pattern->flats,
                                     pattern->pieces, pattern->pieceIndex));
  }
}

void drawPicture(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  for (auto _ : state) benchmark::DoNotOptimize(renderPattern(*pattern));
}

void writeDrawings(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  for (auto _ : state) {
    benchmark::DoNotOptimize(writeDxf(*pattern));
    benchmark::DoNotOptimize(writeSvg(drawSheet(*pattern)));
    benchmark::DoNotOptimize(writePdf(drawSheet(*pattern)));
  }
}

void writeReports(benchmark::State& state, const Shape& shape) {
  const auto pattern = make(state, shape);
  if (!pattern) return;
  for (auto _ : state) {
    benchmark::DoNotOptimize(writeReportJson(*pattern));
    benchmark::DoNotOptimize(writeReportHtml(*pattern));
    for (std::size_t i = 0; i < pattern->cut.pieces.size(); ++i) {
      if (!pattern->flats[i]) continue;
      benchmark::DoNotOptimize(writePieceObj(pattern->cut.pieces[i], *pattern->flats[i]));
    }
  }
}

void makeAll(benchmark::State& state, const Shape& shape) {
  const auto document = open(state, shape);
  if (!document) return;
  for (auto _ : state) benchmark::DoNotOptimize(makePattern(*document));
}

/// Nothing changed since the last time: what the cache leaves to do.
void makeAgain(benchmark::State& state, const Shape& shape) {
  const auto document = open(state, shape);
  if (!document) return;
  PatternCache cache;
  benchmark::DoNotOptimize(makePattern(*document, {}, &cache));
  for (auto _ : state) benchmark::DoNotOptimize(makePattern(*document, {}, &cache));
}

/// What `toile make` does, from the design file to the last result file.
void wholeWay(benchmark::State& state, const Shape& shape) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "toile-pipeline-bench";
  for (auto _ : state) {
    const auto pattern = make(state, shape);
    if (!pattern) return;
    const Result<WrittenPattern> written = writePattern(*pattern, folder);
    if (!written) return state.SkipWithError(written.error().message.c_str());
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

/// What a user waits for after the last piece is unfolded: layout, finishing and all files.
void finishAndWrite(benchmark::State& state, const Shape& shape) {
  auto pattern = make(state, shape);
  if (!pattern) return;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "toile-pipeline-bench";
  for (auto _ : state) {
    auto pieces = finish(pattern->document, pattern->curves, pattern->cut, pattern->flats);
    if (!pieces) return state.SkipWithError(pieces.error().message.c_str());
    pattern->pieces = *std::move(pieces);
    auto layout = arrange(*pattern->document.model, pattern->cut, pattern->flats, pattern->pieces,
                          pattern->pieceIndex);
    if (!layout) return state.SkipWithError(layout.error().message.c_str());
    pattern->layout = *std::move(layout);
    const Result<WrittenPattern> written = writePattern(*pattern, folder);
    if (!written) return state.SkipWithError(written.error().message.c_str());
  }
  state.counters["pieces"] = static_cast<double>(pattern->pieces.size());
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

using Step = void (*)(benchmark::State&, const Shape&);

const bool kRegistered = [] {
  const std::pair<const char*, Step> steps[] = {{"Yardstick", yardstick},
                                                {"Open", openTheDocument},
                                                {"PlaceCurves", place},
                                                {"Cut", cutAll},
                                                {"UnfoldOneThread", unfoldAll},
                                                {"Finish", finishAll},
                                                {"Arrange", arrangeAll},
                                                {"MakePattern", makeAll},
                                                {"MakePatternAgain", makeAgain},
                                                {"Picture", drawPicture},
                                                {"Drawings", writeDrawings},
                                                {"Reports", writeReports},
                                                {"FinishAndWrite", finishAndWrite},
                                                {"WholeWay", wholeWay}};
  for (const auto& [shapeName, shape] :
       {std::pair("Vest", kVest), std::pair("Wetsuit", kWetsuit)}) {
    for (const auto& [name, step] : steps) {
      benchmark::RegisterBenchmark(
          (std::string("BM_Pipeline") + shapeName + "/" + name).c_str(),
          [step = step, shape = shape](benchmark::State& state) { step(state, shape); })
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
    }
  }
  return true;
}();

}  // namespace
}  // namespace toile
