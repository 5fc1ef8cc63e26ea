// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "toile/core/content_hash.h"
#include "toile/core/version.h"
#include "toile/io/dxf.h"
#include "toile/io/sewing_files.h"

namespace toile {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector2d;

double rounded(double mm) {
  const double value = std::round(mm * 1000) / 1000;
  return value == 0 ? 0.0 : value;
}

/// Points of an edge on the sheet, along the piece's outline or, for the second side of a seam,
/// against it, so that mates run alike.
std::vector<Vector2d> pointsOf(const Pattern& pattern, const SewEdge& edge, bool backward) {
  const PatternPiece& piece = pattern.pieces[edge.piece];
  std::vector<Vector2d> points;
  for (const std::uint32_t r : edge.runs) {
    const OutlineRun& run = piece.runs[r];
    const Outline& loop = piece.sewLines[run.loop];
    for (std::size_t k = points.empty() ? 0 : 1; k <= run.edgeCount; ++k)
      points.push_back(pattern.layout.placements[edge.piece].apply(
          loop[(run.first + k) % loop.size()].position));
  }
  if (backward) std::reverse(points.begin(), points.end());
  return points;
}

/// Arc lengths of the notches of a piece that stand within the edge, with their numbers. One at an
/// end belongs to the next edge as well, and ends meet anyway.
Json notchesOn(const Pattern& pattern, const SewEdge& edge, const std::vector<Vector2d>& points) {
  struct Found {
    double along;
    int number;
  };
  std::vector<Found> found;
  const PatternPiece& piece = pattern.pieces[edge.piece];
  for (const Notch& notch : piece.notches) {
    if (notch.number == 0 || notch.seam != edge.curve) continue;
    const Vector2d at = pattern.layout.placements[edge.piece].apply(notch.onSewLine);
    double along = 0;
    double best = 0.2;  // mm: smoothing may have moved the line by a little
    double place = -1;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vector2d d = points[i + 1] - points[i];
      const double length = d.norm();
      const double t =
          length > 0 ? std::clamp((at - points[i]).dot(d) / (length * length), 0.0, 1.0) : 0;
      const double off = (points[i] + t * d - at).norm();
      if (off < best) {
        best = off;
        place = along + t * length;
      }
      along += length;
    }
    if (place >= 0) found.push_back({place, notch.number});
  }
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  constexpr double kAtEndMm = 0.5;
  std::erase_if(found, [&](const Found& each) {
    return each.along < kAtEndMm || each.along > length - kAtEndMm;
  });
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.along < b.along; });
  Json list = Json::array();
  for (const Found& each : found)
    list.push_back({{"number", each.number}, {"at", rounded(each.along)}});
  return list;
}

const char* kindName(SewStep::Kind kind) {
  switch (kind) {
    case SewStep::Kind::Dart:
      return "dart";
    case SewStep::Kind::Flat:
      return "flat";
    case SewStep::Kind::Tube:
      return "tube";
    case SewStep::Kind::Round:
      return "round";
  }
  return "";
}

}  // namespace

std::string writeSeamsJson(const Pattern& pattern) {
  const SewingPlan plan = planSewing(pattern);
  const std::vector<std::string> blocks = dxfBlockNames(pattern);
  Json json{{"format", "toile-seams"},
            {"version", kSeamsFormatVersion},
            {"program", fmt::format("toile {}", version())},
            {"units", "mm"},
            {"drawing", "pattern.dxf"},
            {"inputs", inputsHash(pattern.document).hex()}};
  json["pieces"] = Json::array();
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
    const PatternPiece& piece = pattern.pieces[i];
    json["pieces"].push_back({{"id", piece.id},
                              {"name", piece.name},
                              {"number", piece.number},
                              {"count", piece.count},
                              {"fabric", piece.fabric},
                              {"block", blocks[i]}});
  }
  std::vector<char> isBackward(plan.edges.size(), 0);
  for (const SewStep& step : plan.steps) isBackward[step.edgeB] = 1;
  json["edges"] = Json::array();
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const SewEdge& edge = plan.edges[e];
    if (edge.mate == e) continue;  // cut away on a fold
    const std::vector<Vector2d> points = pointsOf(pattern, edge, isBackward[e] != 0);
    Json list = Json::array();
    for (const Vector2d& p : points) list.push_back({rounded(p.x()), rounded(p.y())});
    const PatternPiece& piece = pattern.pieces[edge.piece];
    json["edges"].push_back({{"code", edge.code},
                             {"mate", plan.edges[edge.mate].code},
                             {"piece", piece.id},
                             {"curve", edge.curve},
                             {"allowance", piece.runs[edge.runs.front()].allowance},
                             {"body", edge.body},
                             {"target", edge.target},
                             {"length", edge.length},
                             {"closed", edge.isRing},
                             {"notches", notchesOn(pattern, edge, points)},
                             {"points", std::move(list)}});
  }
  json["steps"] = Json::array();
  for (const SewStep& step : plan.steps)
    json["steps"].push_back({{"kind", kindName(step.kind)},
                             {"edges", {plan.edges[step.edgeA].code, plan.edges[step.edgeB].code}},
                             {"length", step.length},
                             {"minutes", rounded(step.minutes)}});
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string writeLengthsCsv(const Pattern& pattern) {
  const auto field = [](const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
      if (c == '"') quoted += '"';
      quoted += c == '\r' || c == '\n' ? ' ' : c;
    }
    return quoted + "\"";
  };
  std::string csv = fmt::format("# toile {} lengths in mm; inputs {}\n", version(),
                                inputsHash(pattern.document).hex());
  csv += "piece,edge,curve,name,kind,rule,body,target,pattern,mate piece,mate,difference\n";
  for (const LengthLine& line : lengthContract(pattern)) {
    const bool isFree = line.rule == LengthRule::Free;
    const auto length = [](double mm) { return fmt::format("{:.4f}", mm); };
    const std::string difference = length(std::abs(line.difference) < 5e-5 ? 0 : line.difference);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", field(line.piece), line.edge,
                       field(line.curve), field(line.name), line.kind, toString(line.rule),
                       isFree ? "" : length(line.body), isFree ? "" : length(line.target),
                       length(line.pattern), field(line.matePiece),
                       line.matePiece.empty() ? "" : length(line.mate), isFree ? "" : difference);
  }
  return csv;
}

}  // namespace toile
