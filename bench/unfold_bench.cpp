// SPDX-License-Identifier: GPL-3.0-or-later
// Unfolding the shared patches, each beside two yardsticks in the same run: CGAL's LSCM and ARAP of
// the same piece and one factorisation of its Laplacian.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "cgal_parameterization.h"
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

void previewPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  FlatPiece flat;
  for (auto _ : state) flat = *UnfoldPreview().update(*piece);
  state.counters["area_error_percent"] = 100 * flat.meanAreaError;
  state.counters["length_error"] = flat.check.maxLengthError;
}

/// The piece with another shape: swollen by half a percent of its size at one place.
Piece swollen(const Piece& piece, double share) {
  std::vector<Eigen::Vector3d> positions = piece.mesh->positions();
  const Eigen::Vector3d middle = 0.5 * (piece.mesh->boxMin() + piece.mesh->boxMax());
  const double size = (piece.mesh->boxMax() - piece.mesh->boxMin()).norm();
  for (Eigen::Vector3d& p : positions) {
    const Eigen::Vector3d away = p - middle;
    p += share * size * away.normalized() * std::exp(-away.squaredNorm() / (0.05 * size * size));
  }
  Piece other = piece;
  other.mesh = std::make_shared<const Mesh>(piece.mesh->withPositions(std::move(positions)));
  for (Wire& wire : other.wires) {
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      wire.targetLength[i] =
          (other.mesh->position(wire.vertices[i]) - other.mesh->position(wire.vertices[i + 1]))
              .norm();
    }
  }
  return other;
}

void warmPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  const Piece other = swollen(*piece, 0.005);
  UnfoldPreview preview;
  (void)preview.update(*piece);
  bool changed = false;
  FlatPiece flat;
  for (auto _ : state) {
    changed = !changed;
    flat = *preview.update(changed ? other : *piece);
  }
  state.counters["area_error_percent"] = 100 * flat.meanAreaError;
  state.counters["length_error"] = flat.check.maxLengthError;
}

void cgalPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  for (auto _ : state) benchmark::DoNotOptimize(cgalLscm(*piece->mesh));
}

void arapPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  for (auto _ : state) benchmark::DoNotOptimize(cgalArap(*piece->mesh));
}

void factorPatch(benchmark::State& state, const std::string& name) {
  const Piece* piece = patch(name);
  if (piece == nullptr) return state.SkipWithError("no test data; set TOILE_TEST_DATA");
  factorise(state, *piece->mesh);
}

/// Growth of the cost: a bent sheet of 2 n^2 triangles.
void unfoldSheet(benchmark::State& state) {
  const auto n = static_cast<int>(std::sqrt(static_cast<double>(state.range(0)) / 2));
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      positions.emplace_back(200 * u, 300 * v, 25 * std::sin(3 * u) * std::cos(2.5 * v));
    }
  }
  const auto at = [n](int i, int j) { return VertexId(static_cast<std::size_t>(j * (n + 1) + i)); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const Piece piece = *makePiece("sheet", *makeMesh(positions, triangles), {});
  FlatPiece flat;
  for (auto _ : state) flat = *unfold(piece);
  state.counters["steps"] = flat.steps;
  state.SetComplexityN(state.range(0));
}
BENCHMARK(unfoldSheet)
    ->Name("UnfoldSheet")
    ->Arg(1000)
    ->Arg(4000)
    ->Arg(16000)
    ->Arg(64000)
    ->Arg(100000)
    ->Arg(400000)
    ->Complexity()
    ->Unit(benchmark::kMillisecond);

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
    add("Preview", previewPatch);
    add("WarmPreview", warmPatch);
    add("CgalLscm", cgalPatch);
    if (!std::string_view(name).ends_with("100k")) add("CgalArap", arapPatch);
    add("Factorisation", factorPatch);
  }
  return 0;
}();

}  // namespace
}  // namespace toile::bench
