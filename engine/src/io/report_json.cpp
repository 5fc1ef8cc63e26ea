// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/report_data.h"
#include "toile/core/version.h"
#include "toile/io/report.h"

namespace toile {
namespace {

using Json = nlohmann::ordered_json;

Json elements(const std::vector<Element>& where) {
  Json list = Json::array();
  for (const Element& element : where) {
    Json json{{"kind", toString(element.kind)}};
    if (element.name.empty()) {
      json["index"] = element.index;
    } else {
      json["name"] = element.name;
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json toJson(const Finding& finding) {
  return {{"code", finding.code}, {"message", finding.message}, {"where", elements(finding.where)}};
}

Json toJson(const Spread& spread) {
  return {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}};
}

Json toJson(const Lengths& lengths, bool hasFlat) {
  Json json{{"body", lengths.body}, {"target", lengths.target}};
  json["flat"] = hasFlat ? Json(lengths.flat) : Json(nullptr);
  return json;
}

Json toJson(const UnfoldCheck& check) {
  return {{"passes", check.passes()},
          {"maxLengthError", check.maxLengthError},
          {"maxClosureGap", check.maxClosureGap},
          {"flippedFaces", check.flippedFaces},
          {"crossings", check.crossings},
          {"maxTurnError", check.maxTurnError}};
}

/// Least, mean (by area on the body) and greatest of the kinds of strain, and the worst places.
Json toJson(const PieceStrain& strain, const Mesh& mesh) {
  Json json;
  for (const StrainKind kind : kStrainKinds) {
    Spread spread{std::numeric_limits<double>::infinity(), 0,
                  -std::numeric_limits<double>::infinity()};
    double total = 0;
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
      const double value = strain.faces[FaceId(f)].of(kind), area = mesh.area(FaceId(f));
      spread.min = std::min(spread.min, value);
      spread.max = std::max(spread.max, value);
      spread.mean += area * value;
      total += area;
    }
    spread.mean = total > 0 ? spread.mean / total : 0;
    json[std::string(toString(kind))] = toJson(spread);
    if (const auto limit = strain.limits.of(kind)) {
      json[std::string(toString(kind))]["limit"] = *limit;
    }
  }
  json["overLimit"] = strain.overLimit;
  json["worst"] = Json::array();
  for (const StrainSpot& spot : strain.worst) {
    Json place{{"vertex", spot.vertex.index()},
               {"kind", toString(spot.kind)},
               {"value", spot.value},
               {"place", spot.place},
               {"words", describe(spot)}};
    place["limit"] = spot.limit ? Json(*spot.limit) : Json(nullptr);
    json["worst"].push_back(std::move(place));
  }
  return json;
}

Json toJson(const DevelopedPiece& developed) {
  const DevelopReport& report = developed.report;
  return {{"amount", developed.amount},
          {"meanAreaErrorBefore", report.errorBefore},
          {"meanAreaErrorAgainstBody", report.errorAgainstOriginal},
          {"maxDefectBefore", report.maxDefectBefore},
          {"maxDefect", report.maxDefect},
          {"roughnessBefore", report.roughnessBefore},
          {"roughness", report.roughness},
          {"maxMove", report.maxMove},
          {"maxFeatureChange", report.maxFeatureChange}};
}

Json wiresJson(const Pattern& pattern, const ReportData& data, std::size_t index) {
  const Piece& piece = pattern.cut.pieces[index];
  const bool hasFlat = pattern.flats[index] != nullptr;
  Json list = Json::array();
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    const WireReport& report = data.pieces[index].wires[w];
    Json json{{"kind", toString(wire.kind)},
              {"curve", wire.curve},
              {"part", wire.part},
              {"group", wireGroup(wire)},
              {"edges", wire.targetLength.size()},
              {"closed", !wire.vertices.empty() && wire.vertices.front() == wire.vertices.back()},
              {"length", toJson(report.lengths, hasFlat)}};
    json["maxEdgeError"] = hasFlat ? Json(report.maxEdgeError) : Json(nullptr);
    if (report.mate) {
      const WireReport& mate = data.pieces[report.mate->piece].wires[report.mate->wire];
      json["mate"] = {
          {"piece", pattern.cut.pieces[report.mate->piece].id},
          {"wire", report.mate->wire},
          {"length", toJson(mate.lengths, pattern.flats[report.mate->piece] != nullptr)}};
    } else {
      json["mate"] = nullptr;
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json pieceJson(const Pattern& pattern, const ReportData& data, std::size_t index,
               const std::string& fileName) {
  const Piece& piece = pattern.cut.pieces[index];
  const PieceReport& report = data.pieces[index];
  const FlatPiece* flat = pattern.flats[index].get();
  Json json{{"id", piece.id},
            {"name", piece.name},
            {"included", piece.include},
            {"unfolded", flat != nullptr}};
  json["file"] = flat != nullptr ? Json("pieces/" + fileName) : Json(nullptr);
  json["vertices"] = piece.mesh->vertexCount();
  json["faces"] = piece.mesh->faceCount();
  json["area"] = {{"body", report.bodyArea}};
  json["area"]["flat"] = flat != nullptr ? Json(report.flatArea) : Json(nullptr);
  if (flat != nullptr) {
    json["distortion"] = {{"stretchMin", toJson(report.stretchMin)},
                          {"stretchMax", toJson(report.stretchMax)},
                          {"areaRatio", toJson(report.areaRatio)},
                          {"meanAreaError", flat->meanAreaError},
                          {"maxAreaError", flat->maxAreaError}};
    if (report.strain) json["strain"] = toJson(*report.strain, *piece.mesh);
    json["check"] = toJson(flat->check);
    if (index < pattern.developed.size() && pattern.developed[index]) {
      json["developed"] = toJson(*pattern.developed[index]);
    }
    json["solver"] = {{"steps", flat->steps}, {"wireStiffness", flat->wireStiffness}};
  }
  json["wires"] = wiresJson(pattern, data, index);
  return json;
}

}  // namespace

std::string writeReportJson(const Pattern& pattern) {
  const ReportData data = measure(pattern);
  const ReferenceModel& model = *pattern.document.model;
  Json json{{"format", "toile-report"},
            {"version", kReportFormatVersion},
            {"program", fmt::format("toile {}", version())},
            {"units", "mm"},
            {"complete", pattern.isComplete()},
            {"design", {{"name", pattern.document.design->name}}},
            {"model",
             {{"name", model.name},
              {"vertices", model.mesh->vertexCount()},
              {"faces", model.mesh->faceCount()},
              {"connectivity", model.mesh->connectivityHash().hex()}}},
            {"totals",
             {{"pieces", pattern.cut.pieces.size()},
              {"unfolded", data.unfolded},
              {"seams", pattern.cut.mates.size()},
              {"wireEdges", data.wireEdges},
              {"includedArea", pattern.cut.includedArea},
              {"sumOfPieceAreas", data.includedArea},
              {"flatArea", data.flatArea},
              {"maxEdgeError", data.maxEdgeError}}}};

  const std::vector<std::string> files = pieceFileNames(pattern.cut);
  json["pieces"] = Json::array();
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    json["pieces"].push_back(pieceJson(pattern, data, i, files[i]));
  }
  json["elastics"] = Json::array();
  for (const ElasticLine& line : pattern.elastics) {
    json["elastics"].push_back(
        {{"curve", line.curve}, {"range", line.range}, {"ratio", line.ratio}});
  }
  json["findings"] = Json::array();
  for (const Finding& finding : pattern.findings) json["findings"].push_back(toJson(finding));
  json["failures"] = Json::array();
  for (std::size_t i = 0; i < pattern.failures.size(); ++i) {
    if (!pattern.failures[i]) continue;
    const Error& error = *pattern.failures[i];
    json["failures"].push_back({{"piece", pattern.cut.pieces[i].id},
                                {"code", toString(error.code)},
                                {"message", error.message},
                                {"where", elements(error.where)}});
  }
  // Names come from files of any encoding; a byte that is no UTF-8 must not stop the report.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace toile
