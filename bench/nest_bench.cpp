// SPDX-License-Identifier: GPL-3.0-or-later
// Marker sets of five trades and one of 100 pieces: utilisation, how far the length stands above
// what the area alone needs, and the time. Shoe, toy and armchair are models of TOILE_TEST_DATA cut
// by planes; without the data they are left out. Yardstick: the first fill (effort 0).
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "toile/pipeline.h"
#include "toile/pipeline/marker.h"

namespace {

using namespace toile;

struct Cut {
  Eigen::Vector3d normal;
  double at;  ///< share of the model's box along the normal
};

/// A model cut along plane sections.
std::optional<Pattern> sectioned(const std::string& file, const std::vector<Cut>& cuts) {
  const char* data = std::getenv("TOILE_TEST_DATA");
  const std::filesystem::path path =
      std::filesystem::path(data != nullptr ? data : TOILE_SOURCE_DIR "/../shared/data") / file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  const auto model = readModel(path, FileUnit::Millimetre);
  if (!model) return std::nullopt;
  auto design = std::make_shared<Design>();
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double low = cuts[i].normal.dot(model->mesh->boxMin());
    const double high = cuts[i].normal.dot(model->mesh->boxMax());
    StylingCurve curve;
    curve.id = "cut-" + std::to_string(i);
    curve.closed = true;
    AlongSection way;
    way.plane.normal = cuts[i].normal;
    way.plane.through = Length::mm(low + cuts[i].at * (high - low));
    curve.way = way;
    design->curves.push_back(curve);
  }
  MakeOptions options;
  options.autoCut = true;
  auto pattern = makePattern({design, std::make_shared<const ReferenceModel>(*model)}, options);
  if (!pattern || pattern->pieces.empty()) return std::nullopt;
  return *std::move(pattern);
}

std::optional<Pattern> wetsuit(const std::optional<std::string>& body = std::nullopt) {
  const auto document = openDocument(TOILE_SOURCE_DIR "/examples/wetsuit-full.toile", body);
  if (!document) return std::nullopt;
  auto pattern = makePattern(*document);
  if (!pattern) return std::nullopt;
  return *std::move(pattern);
}

struct MarkerSet {
  const char* name;
  MarkerOptions options;
  std::vector<Pattern> orders;
};

MarkerSet makeSet(std::int64_t number) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  MarkerSet set;
  const auto add = [&](std::optional<Pattern> pattern) {
    if (pattern) set.orders.push_back(*std::move(pattern));
  };
  switch (number) {
    case 0:
      set.name = "wetsuit";
      add(wetsuit());
      break;
    case 1:
      set.name = "three wetsuits";
      for (const char* size : {"EU36F", "EU42F", "EU50M"})
        add(wetsuit(std::string("builtin:body@1?size=") + size));
      break;
    case 2:
      set.name = "shoe uppers, 6 pairs";
      set.options.width = Length::mm(1000);
      set.options.copies = 6;
      set.options.pairs = true;
      set.options.nest.gap = 3;
      set.options.turns = Turns::Any;
      add(sectioned("lasts/last_female_average_flat_l.ply",
                    {{z, 0.15}, {y, 0.35}, {y, 0.7}, {x, 0.5}}));
      break;
    case 3:
      set.name = "toy, 10 of them";
      set.options.copies = 10;
      set.options.turns = Turns::OneWay;
      set.options.nest.gap = 4;
      add(sectioned("toys/squirrel.ply", {{z, 0.25}, {z, 0.5}, {z, 0.75}, {x, 0.5}}));
      break;
    case 4:
      set.name = "five wetsuits";  // 100 pieces
      for (const char* size : {"EU36F", "EU40F", "EU44F", "EU48M", "EU52M"})
        add(wetsuit(std::string("builtin:body@1?size=") + size));
      break;
    default:
      set.name = "armchair";
      add(sectioned("toys/armchair.ply", {{z, 0.2}, {z, 0.48}, {x, 0.2}, {x, 0.8}, {y, 0.5}}));
      break;
  }
  return set;
}

const MarkerSet& markerSet(std::int64_t number) {
  static std::map<std::int64_t, MarkerSet> sets;
  const auto found = sets.find(number);
  return found != sets.end() ? found->second : sets.emplace(number, makeSet(number)).first->second;
}

/// Arguments: set, effort.
void BM_Nest(benchmark::State& state) {
  const MarkerSet& set = markerSet(state.range(0));
  state.SetLabel(set.name);
  if (set.orders.empty()) return state.SkipWithError("no data");
  MarkerOptions options = set.options;
  options.nest.effort = static_cast<int>(state.range(1));
  for (auto _ : state) {
    const auto markers = makeMarkers(set.orders, options);
    if (!markers) {
      state.SkipWithError(markers.error().message.c_str());
      return;
    }
    double length = 0;
    double bound = 0;
    double copies = 0;
    for (const Marker& marker : *markers) {
      length += marker.nesting.length;
      bound += marker.nesting.bound;
      copies += static_cast<double>(marker.nesting.places.size());
    }
    state.counters["length_mm"] = length;
    state.counters["utilisation"] = bound / length;
    state.counters["copies"] = copies;
  }
}
BENCHMARK(BM_Nest)
    ->ArgsProduct({{0, 1, 2, 3, 4, 5}, {0, 3, 5}})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
