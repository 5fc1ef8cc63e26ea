// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "toile/warp/warp.h"

namespace toile {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings) {
    list.push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return list;
}

}  // namespace

std::string writeWarpReport(const Warp& warp) {
  const WarpReport& r = warp.report;
  Json json = {{"format", "toile-warp"},
               {"version", 1},
               {"product", warp.product.name},
               {"ok", r.isOk()},
               {"reasons", toJson(r.reasons)},
               {"girths", Json::array()},
               {"easeChangeMm", {{"mean", r.meanEaseChange}, {"percentile95", r.easeChange95}}},
               {"insideMm",
                {{"deepestBefore", r.deepestBefore},
                 {"deepestAfter", r.deepestAfter},
                 {"newlyInside", r.deeper}}},
               {"folds", r.folds},
               {"crossings", {{"before", r.crossingsBefore}, {"after", r.crossings}}},
               {"areaRatio", {{"least", r.leastAreaRatio}, {"most", r.mostAreaRatio}}},
               {"findings", toJson(r.findings)}};
  for (const WarpedGirth& girth : r.girths) {
    json["girths"].push_back(
        {{"name", girth.name},
         {"bodyMm", {{"before", girth.bodyBefore}, {"after", girth.bodyAfter}}},
         {"productMm", {{"before", girth.productBefore}, {"after", girth.productAfter}}},
         {"easeMm", {{"before", girth.easeBefore}, {"after", girth.easeAfter}}},
         {"largestErrorMm", girth.largestError}});
  }
  return json.dump(2) + "\n";
}

}  // namespace toile
