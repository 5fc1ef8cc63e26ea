// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "toile/scan/clean_scan.h"

namespace toile {

std::string writeCleanReport(const CleanedScan& cleaned) {
  using Json = nlohmann::ordered_json;
  const CleanReport& r = cleaned.report;
  const Mesh& mesh = *cleaned.model.mesh;
  Json json = {{"format", "toile-scan"},
               {"version", 1},
               {"name", cleaned.model.name},
               {"points", r.points},
               {"lonePoints", r.lonePoints},
               {"flyingParts", r.flyingParts},
               {"flyingPoints", r.flyingPoints},
               {"spacingMm", r.spacing},
               {"edgeMm", r.edge},
               {"heightMm", r.height},
               {"vertices", mesh.vertexCount()},
               {"faces", mesh.faceCount()},
               {"components", mesh.componentCount()},
               {"handles", r.handles},
               {"crossingPairs", r.crossings},
               {"scanToModelMm",
                {{"mean", r.scanToModel.mean},
                 {"median", r.scanToModel.median},
                 {"percentile95", r.scanToModel.percentile95},
                 {"largest", r.scanToModel.largest}}},
               {"inventedAreaMm2", r.inventedArea},
               {"inventedShare", r.inventedShare},
               {"invented", Json::array()},
               {"scanToModel", Json::array()},
               {"findings", Json::array()}};
  for (const InventedPatch& patch : r.invented) {
    json["invented"].push_back(
        {{"place", patch.place},
         {"centreMm", {patch.centre.x(), patch.centre.y(), patch.centre.z()}},
         {"areaMm2", patch.area}});
  }
  for (Eigen::Index row = 0; row < 3; ++row) {
    const auto line = cleaned.standing.matrix().row(row);
    json["scanToModel"].push_back({line[0], line[1], line[2], line[3]});
  }
  for (const Finding& finding : r.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace toile
