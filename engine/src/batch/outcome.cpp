// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch/outcome.h"

#include <nlohmann/json.hpp>

#include "toile/core/file.h"

namespace toile::detail {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t kMostBytes = std::size_t{8} << 20;

}  // namespace

std::string writeOutcome(const OrderOutcome& outcome, const ContentHash& key) {
  Json json = {{"format", "toile-order"},
               {"version", 1},
               {"key", key.hex()},
               {"name", outcome.name},
               {"status", outcome.status},
               {"reason", outcome.reason},
               {"attention", outcome.attention}};
  if (outcome.isFitted) {
    json["fit"] = {{"meanMm", outcome.fitMean},
                   {"percentile95Mm", outcome.fit95},
                   {"missingShare", outcome.missingShare}};
  }
  json["pieces"] = outcome.pieces;
  json["worstAreaError"] = outcome.worstAreaError;
  json["worstPiece"] = outcome.worstPiece;
  json["findings"] = Json::array();
  for (const Finding& finding : outcome.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  json["measuresMm"] = Json::object();
  for (const auto& [name, mm] : outcome.measures) json["measuresMm"][name] = mm;
  return json.dump(2) + "\n";
}

std::optional<ReadOutcome> readOutcome(const std::filesystem::path& folder) {
  const Result<std::string> text = readFile(folder / "order.json", kMostBytes);
  if (!text) return std::nullopt;
  try {
    const Json json = Json::parse(*text);
    if (json.at("format") != "toile-order" || json.at("version") != 1) return std::nullopt;
    ReadOutcome read;
    read.key = json.at("key");
    OrderOutcome& outcome = read.outcome;
    outcome.name = json.at("name");
    outcome.status = json.at("status");
    outcome.reason = json.at("reason");
    outcome.attention = json.at("attention");
    if (const auto fit = json.find("fit"); fit != json.end()) {
      outcome.isFitted = true;
      outcome.fitMean = fit->at("meanMm");
      outcome.fit95 = fit->at("percentile95Mm");
      outcome.missingShare = fit->at("missingShare");
    }
    outcome.pieces = json.at("pieces");
    outcome.worstAreaError = json.at("worstAreaError");
    outcome.worstPiece = json.at("worstPiece");
    for (const Json& finding : json.at("findings")) {
      outcome.findings.push_back({finding.at("code"), finding.at("message"), {}});
    }
    for (const auto& [name, mm] : json.at("measuresMm").items()) outcome.measures[name] = mm;
    return read;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace toile::detail
