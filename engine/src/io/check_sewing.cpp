// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "finish/polygon.h"
#include "toile/io/sewing_files.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Json = nlohmann::json;

constexpr double kOnLineMm = 0.05;  // an edge's points lie so near to the sew line
constexpr double kMateMm = 0.05;    // mates may differ by so much
constexpr double kNotchMm = 0.5;    // and their notches
constexpr std::size_t kMostEdges = 100000;

Error damaged(const std::string& reason) {
  return {ErrorCode::FileFormat, "seams.json: " + reason, {}};
}

/// The sew line of a block as a closed polyline with arc lengths.
struct SewLine {
  Points2 points;
  std::vector<double> along;
  double total = 0;

  explicit SewLine(Points2 loop) : points(std::move(loop)) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      along.push_back(total);
      total += (points[(i + 1) % points.size()] - points[i]).norm();
    }
  }
  struct Place {
    double along = 0, off = 0;
  };
  [[nodiscard]] Place nearest(const Vector2d& p) const {
    Place best{0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector2d d = points[(i + 1) % points.size()] - points[i];
      const double length = d.norm();
      const double t =
          length > 0 ? std::clamp((p - points[i]).dot(d) / (length * length), 0.0, 1.0) : 0;
      const double off = (points[i] + t * d - p).norm();
      if (off < best.off) best = {along[i] + t * length, off};
    }
    return best;
  }
};

struct Edge {
  std::string code, mate, block, piece;
  Points2 points;
  double target = 0;
  bool closed = false;
  std::map<int, std::vector<double>> notches;  ///< number -> arc lengths
};

class Checker {
 public:
  Checker(const Json& json, const DxfDrawing& drawing) : json_(json), drawing_(drawing) {}

  Result<SewingCheck> check() {
    try {
      readEdges();
    } catch (const Json::exception&) {
      return damaged("a key is missing or of another kind; write it anew with toile make");
    }
    if (edges_.size() > kMostEdges) return damaged("it has too many edges");
    for (const auto& [code, edge] : edges_) {
      const auto mate = edges_.find(edge.mate);
      if (mate == edges_.end() || mate->second.mate != code) {
        find("mate-missing",
             fmt::format("edge {} is to meet {}, which {}", code, edge.mate,
                         mate == edges_.end() ? "there is not" : "says that it meets another"),
             edge.piece);
        continue;
      }
      if (code < edge.mate) sew(edge, mate->second);
    }
    return std::move(result_);
  }

 private:
  void find(const std::string& code, const std::string& message, const std::string& piece) {
    result_.findings.push_back({code, message, {Element::piece(piece)}});
  }

  void readEdges() {
    std::map<std::string, std::string> blocks;
    for (const Json& piece : json_.at("pieces"))
      blocks[piece.at("id").get<std::string>()] = piece.at("block").get<std::string>();
    for (const Json& each : json_.at("edges")) {
      Edge edge;
      edge.code = each.at("code").get<std::string>();
      edge.mate = each.at("mate").get<std::string>();
      edge.piece = each.at("piece").get<std::string>();
      edge.block = blocks[edge.piece];
      edge.target = each.at("target").get<double>();
      edge.closed = each.at("closed").get<bool>();
      for (const Json& p : each.at("points"))
        edge.points.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
      for (const Json& notch : each.at("notches"))
        edge.notches[notch.at("number").get<int>()].push_back(notch.at("at").get<double>());
      edges_.emplace(edge.code, std::move(edge));
    }
  }

  /// The lines of a block that are sewn: layer 14, or the cut lines where there is no allowance.
  const std::vector<SewLine>& sewLines(const std::string& block) {
    const auto known = lines_.find(block);
    if (known != lines_.end()) return known->second;
    std::vector<SewLine>& lines = lines_[block];
    const double mm = millimetresPer(drawing_.unit);
    for (const DxfBlock& each : drawing_.blocks) {
      if (each.name != block) continue;
      const bool hasSew =
          std::any_of(each.entities.begin(), each.entities.end(), [](const DxfEntity& entity) {
            return entity.kind == DxfEntity::Kind::Polyline && entity.layer == "14";
          });
      for (const DxfEntity& entity : each.entities) {
        const bool isSewn =
            hasSew ? entity.layer == "14" : entity.layer == "1" || entity.layer == "11";
        if (entity.kind != DxfEntity::Kind::Polyline || !isSewn || !entity.closed) continue;
        Points2 points;
        for (const Vector2d& p : entity.points) points.push_back(mm * p);
        lines.emplace_back(std::move(points));
      }
    }
    return lines;
  }

  /// Length of the edge along its sew line in the drawing; nothing where it is not on it.
  std::optional<double> measure(const Edge& edge) {
    if (edge.points.size() < 2) return std::nullopt;
    for (const SewLine& line : sewLines(edge.block)) {
      std::vector<SewLine::Place> places;
      for (const Vector2d& p : edge.points) places.push_back(line.nearest(p));
      if (std::any_of(places.begin(), places.end(),
                      [](const auto& place) { return place.off > kOnLineMm; }))
        continue;
      if (edge.closed) return line.total;
      // Step by step, each the shorter way round.
      double length = 0;
      for (std::size_t i = 1; i < places.size(); ++i) {
        const double d = std::abs(places[i].along - places[i - 1].along);
        length += std::min(d, line.total - d);
      }
      return length;
    }
    return std::nullopt;
  }

  void sew(const Edge& a, const Edge& b) {
    SewingCheck::Seam seam{a.code, b.code, 0, 0, a.target, 0, 0};
    const auto lengthA = measure(a);
    const auto lengthB = measure(b);
    for (const auto& [edge, length] : {std::pair(&a, lengthA), std::pair(&b, lengthB)})
      if (!length)
        find("edge-not-found",
             fmt::format("edge {} does not lie on a sew line of block {} in the drawing",
                         edge->code, edge->block),
             edge->piece);
    if (!lengthA || !lengthB) return;
    seam.lengthA = *lengthA;
    seam.lengthB = *lengthB;
    if (std::abs(seam.lengthA - seam.lengthB) > kMateMm)
      find("mates-differ",
           fmt::format("edges {} and {} are {:.2f} and {:.2f} mm long, {:.2f} mm apart", a.code,
                       b.code, seam.lengthA, seam.lengthB, std::abs(seam.lengthA - seam.lengthB)),
           a.piece);
    for (const auto& [number, places] : a.notches) {
      const auto other = b.notches.find(number);
      if (other == b.notches.end() || other->second.size() != places.size()) {
        find("notch-without-mate",
             fmt::format("notch {} of edge {} meets none on {}", number, a.code, b.code), a.piece);
        continue;
      }
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double off = std::abs(places[i] - other->second[i]);
        seam.notchOff = std::max(seam.notchOff, off);
        ++seam.notches;
        if (off > kNotchMm)
          find("notches-differ",
               fmt::format("notch {} stands {:.2f} mm apart on edges {} and {}", number, off,
                           a.code, b.code),
               a.piece);
      }
    }
    result_.seams.push_back(seam);
  }

  const Json& json_;
  const DxfDrawing& drawing_;
  std::map<std::string, Edge> edges_;
  std::map<std::string, std::vector<SewLine>> lines_;
  SewingCheck result_;
};

}  // namespace

Result<SewingCheck> checkSewing(std::string_view seamsJson, const DxfDrawing& drawing) {
  const Json json = Json::parse(seamsJson, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return damaged("it is no JSON object");
  if (!json.contains("format") || json["format"] != "toile-seams")
    return damaged("it is of another format");
  if (!json.contains("version") || json["version"] != kSeamsFormatVersion)
    return damaged("it is of another version; write it anew with toile make");
  return Checker(json, drawing).check();
}

}  // namespace toile
