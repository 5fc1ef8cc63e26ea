// SPDX-License-Identifier: GPL-3.0-or-later
// Unfolding the shared patches, each beside two yardsticks in the same run: CGAL's LSCM of the same
// piece and one factorisation of its Laplacian.
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "cgal_lscm.h"
#include "support/yardstick.h"
#include "toile/unfold/unfold.h"

namespace toile::bench {
namespace {

/// The piece of a patch, read once; null where the data is absent.
const Piece* patch(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Piece>> pieces;
  const auto [entry, isNew] = pieces.try_emplace(name);
  if (!isNew) return entry->second.get();
  const Result<MeshFile> file =
      readMesh(dataFile("patches/" + name + ".obj"), {.unit = FileUnit::Millimetre});
  if (!file) return nullptr;
  Result<Piece> piece = makePiece(name, file->mesh, file->chains, file->targets);
  if (piece) entry->second = std::make_unique<Piece>(*std::move(piece));
  return entry->second.get();
}

void unfoldPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  FlatPiece flat;
  for (auto _ : state) flat = *unfold(*piece);
  state.counters["faces"] = static_cast<double>(piece->mesh->faceCount());
  state.counters["steps"] = flat.steps;
  state.counters["area_error_percent"] = 100 * flat.meanAreaError;
  state.counters["length_error"] = flat.check.maxLengthError;
  state.counters["flips"] = static_cast<double>(flat.check.flippedFaces);
  state.counters["crossings"] = static_cast<double>(flat.check.crossings);
}

void cgalPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  for (auto _ : state) benchmark::DoNotOptimize(cgalLscm(*piece->mesh));
}

void factorPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  factorise(state, *piece->mesh);
}

const int kRegistered = [] {
  for (const char* name :
       {"sleeve_1k", "sleeve_10k", "sleeve_100k", "saddle_10k", "cap_10k", "cyl_10k",
        "body_legfront", "body_torsofront", "body_torsoquarter", "body_torsoback"}) {
    const auto add = [&](const char* what, void (*run)(benchmark::State&, const std::string&)) {
      benchmark::RegisterBenchmark((std::string(what) + "/" + name).c_str(),
                                   [run, name](benchmark::State& state) { run(state, name); })
          ->Unit(benchmark::kMillisecond);
    };
    add("Unfold", unfoldPatch);
    add("CgalLscm", cgalPatch);
    add("Factorisation", factorPatch);
  }
  return 0;
}();

}  // namespace
}  // namespace toile::bench
