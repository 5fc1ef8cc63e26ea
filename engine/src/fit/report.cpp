// SPDX-License-Identifier: GPL-3.0-or-later
// What a fit reads and writes as JSON: places on a scan, and its report.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "toile/fit/fit.h"

namespace toile {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLandmarks = 10000;

Json toJson(const DistanceSummary& summary) {
  return {{"mean", summary.mean},
          {"median", summary.median},
          {"percentile95", summary.percentile95},
          {"largest", summary.largest}};
}

}  // namespace

Result<std::map<std::string, Eigen::Vector3d>> parseScanLandmarks(std::string_view json,
                                                                  const std::string& file) {
  const auto fail = [&](std::string what) {
    return Error{ErrorCode::FileFormat, fmt::format("{}: {}", file, what), {}};
  };
  const nlohmann::json parsed = nlohmann::json::parse(json, nullptr, /*allow_exceptions=*/false);
  if (parsed.is_discarded()) return fail("this is no JSON");
  const auto list = parsed.is_object() ? parsed.find("landmarks") : parsed.end();
  if (list == parsed.end() || !list->is_object() || list->size() > kMostLandmarks) {
    return fail("an object \"landmarks\" is needed, with a place [x, y, z] in mm for every name");
  }
  std::map<std::string, Eigen::Vector3d> places;
  for (const auto& [name, value] : list->items()) {
    Eigen::Vector3d place;
    bool isPlace = value.is_array() && value.size() == 3;
    for (std::size_t k = 0; isPlace && k < 3; ++k) {
      isPlace = value[k].is_number();
      if (isPlace) place[static_cast<Eigen::Index>(k)] = value[k].get<double>();
    }
    if (!isPlace || !place.allFinite()) {
      Error error = fail(fmt::format("landmark \"{}\" needs three numbers, mm on the scan", name));
      error.where = {Element::landmark(name)};
      return error;
    }
    places[name] = place;
  }
  return places;
}

std::string writeFitReport(const Fit& fit) {
  const FitReport& r = fit.report;
  Json json = {{"format", "toile-fit"},
               {"version", 1},
               {"ok", r.isOk()},
               {"reasons", Json::array()},
               {"scanToFitMm", toJson(r.scanToFit)},
               {"fitToScanMm", toJson(r.fitToScan)},
               {"roundTripMm", toJson(r.roundTrip)},
               {"landmarksMm", toJson(r.landmarks)},
               {"strayShare", r.strayShare},
               {"missingShare", r.missingShare},
               {"flippedFaces", r.flippedFaces},
               {"crossings", r.crossings},
               {"scale", r.scale},
               {"placementMargin", r.placementMargin},
               {"mirrorScore", r.mirrorScore},
               {"familySize", r.familySize},
               {"findings", Json::array()},
               {"regions", Json::array()}};
  for (const Finding& reason : r.reasons) {
    json["reasons"].push_back({{"code", reason.code}, {"message", reason.message}});
  }
  for (const Finding& finding : r.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  for (const FitRegion& region : r.regions) {
    json["regions"].push_back({{"name", region.name},
                               {"scanToFitMm", toJson(region.scanToFit)},
                               {"missingShare", region.missingShare}});
  }
  Json& rows = json["templateToScan"] = Json::array();
  for (Eigen::Index i = 0; i < 3; ++i) {
    rows.push_back({fit.placement.matrix()(i, 0), fit.placement.matrix()(i, 1),
                    fit.placement.matrix()(i, 2), fit.placement.matrix()(i, 3)});
  }
  return json.dump(2) + "\n";
}

}  // namespace toile
