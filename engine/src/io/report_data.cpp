// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace toile {
namespace {

/// Sums in one order whichever way the wire runs, so that mates with equal edges have equal sums.
double sumAlong(const Wire& wire, const std::vector<double>& lengths) {
  std::vector<std::pair<std::uint32_t, double>> ordered;
  ordered.reserve(lengths.size());
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const std::uint32_t key = i < wire.cutEdges.size() ? wire.cutEdges[i].index() : 0;
    ordered.emplace_back(key, lengths[i]);
  }
  std::sort(ordered.begin(), ordered.end());
  double sum = 0;
  for (const auto& [key, length] : ordered) sum += length;
  return sum;
}

double flatArea(const Mesh& mesh, const FlatPiece& flat) {
  double twice = 0;
  for (const Triangle& t : mesh.triangles()) {
    const Eigen::Vector2d a = flat.position[t[1]] - flat.position[t[0]];
    const Eigen::Vector2d b = flat.position[t[2]] - flat.position[t[0]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

class SpreadSum {
 public:
  void add(double value, double weight) {
    spread_.min = std::min(spread_.min, value);
    spread_.max = std::max(spread_.max, value);
    sum_ += value * weight;
    weights_ += weight;
  }
  [[nodiscard]] Spread result() const {
    if (weights_ <= 0) return {};
    return {spread_.min, sum_ / weights_, spread_.max};
  }

 private:
  Spread spread_{std::numeric_limits<double>::infinity(), 0,
                 -std::numeric_limits<double>::infinity()};
  double sum_ = 0;
  double weights_ = 0;
};

WireReport measureWire(const Wire& wire, const FlatPiece* flat) {
  WireReport report;
  report.lengths.body = sumAlong(wire, wire.bodyLength);
  report.lengths.target = sumAlong(wire, wire.targetLength);
  if (flat == nullptr) return report;
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
    lengths.push_back(
        (flat->position[wire.vertices[i + 1]] - flat->position[wire.vertices[i]]).norm());
    const double target = wire.targetLength[i];
    report.maxEdgeError =
        std::max(report.maxEdgeError, std::abs(lengths.back() - target) / std::max(target, 1.0));
  }
  report.lengths.flat = sumAlong(wire, lengths);
  return report;
}

PieceReport measurePiece(const Piece& piece, const FlatPiece* flat) {
  PieceReport report;
  const Mesh& mesh = *piece.mesh;
  SpreadSum stretchMin;
  SpreadSum stretchMax;
  SpreadSum areaRatio;
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const double area = mesh.area(FaceId(i));
    report.bodyArea += area;
    if (flat == nullptr) continue;
    const FaceDistortion& distortion = flat->distortion[FaceId(i)];
    stretchMin.add(distortion.stretchMin, area);
    stretchMax.add(distortion.stretchMax, area);
    areaRatio.add(distortion.areaRatio(), area);
  }
  if (flat != nullptr) {
    report.flatArea = flatArea(mesh, *flat);
    report.stretchMin = stretchMin.result();
    report.stretchMax = stretchMax.result();
    report.areaRatio = areaRatio.result();
  }
  for (const Wire& wire : piece.wires) report.wires.push_back(measureWire(wire, flat));
  return report;
}

}  // namespace

ReportData measure(const Pattern& pattern) {
  ReportData data;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    const FlatPiece* flat = pattern.flats[i].get();
    data.pieces.push_back(measurePiece(piece, flat));
    const PieceReport& report = data.pieces.back();
    if (piece.include) data.includedArea += report.bodyArea;
    if (flat == nullptr) continue;
    ++data.unfolded;
    data.flatArea += report.flatArea;
    for (std::size_t w = 0; w < piece.wires.size(); ++w) {
      data.maxEdgeError = std::max(data.maxEdgeError, report.wires[w].maxEdgeError);
      data.wireEdges += piece.wires[w].targetLength.size();
    }
  }
  std::vector<std::optional<PieceStrain>> strains = measureStrains(pattern);
  for (std::size_t i = 0; i < strains.size(); ++i) data.pieces[i].strain = std::move(strains[i]);
  for (const SeamMates& mates : pattern.cut.mates) {
    data.pieces[mates.pieceA].wires[mates.wireA].mate = WireMate{mates.pieceB, mates.wireB};
    data.pieces[mates.pieceB].wires[mates.wireB].mate = WireMate{mates.pieceA, mates.wireA};
  }
  return data;
}

}  // namespace toile
