// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/strain_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Nearer than this to a landmark is "at" it, mm.
constexpr double kAt = 10;
/// A landmark farther away than this says nothing about the place, mm.
constexpr double kFar = 400;

std::string distanceInWords(double mm) {
  return mm < 20 ? fmt::format("{:.0f} mm", mm) : fmt::format("{:.0f} cm", mm / 10);
}

/// The model faces -y and has its left at +x.
std::string directionInWords(const Vector3d& from) {
  const double flat = std::hypot(from.x(), from.y());
  if (std::abs(from.z()) >= flat) return from.z() < 0 ? "below" : "above";
  if (std::abs(from.x()) >= std::abs(from.y())) {
    return from.x() > 0 ? "to the left of" : "to the right of";
  }
  return from.y() < 0 ? "in front of" : "behind";
}

/// A landmark as people say it: "front" of the "neck", "little-finger side" of the "left wrist".
struct Named {
  std::string aspect, part;
  [[nodiscard]] std::string whole() const {
    return aspect.empty() ? part : fmt::format("{} of the {}", aspect, part);
  }
};

Named namedOf(const std::string& name) {
  std::vector<std::string> words{""};
  for (const char c : name) {
    if (c == '_') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  std::string side;
  if (words.size() > 1 && (words.back() == "l" || words.back() == "r")) {
    side = words.back() == "l" ? "left" : "right";
    words.pop_back();
  }
  const auto withSide = [&](const std::string& what) {
    return side.empty() ? what : side + " " + what;
  };
  const std::string last = words.back();
  const std::string first = words.front();
  const std::string rest =
      fmt::format("{}", fmt::join(words.begin(), words.end() - (words.size() > 1 ? 1 : 0), " "));
  if (words.size() > 1) {
    if (last == "front" || last == "back") return {last, withSide(rest)};
    if (last == "side") return {withSide("side"), rest};
    if (last == "outer" || last == "inner") return {last + " side", withSide(rest)};
    if (first == "wrist" && last == "thumb") return {"thumb side", withSide(rest)};
    if (first == "wrist" && last == "little") return {"little-finger side", withSide(rest)};
    if (first == "toe") return {"", withSide(last + " toe")};
    if (last == "tip") {
      const bool isFinger =
          rest == "index" || rest == "middle" || rest == "ring" || rest == "little";
      return {"tip", withSide(isFinger ? rest + " finger" : rest)};
    }
  }
  return {"", withSide(fmt::format("{}", fmt::join(words, " ")))};
}

std::string byLandmark(const ReferenceModel& model, const Vector3d& place) {
  double nearest = std::numeric_limits<double>::infinity();
  std::string words;
  for (const auto& [name, point] : model.landmarks) {
    const Vector3d from = place - position(*model.mesh, point);
    if (from.norm() >= nearest) continue;
    nearest = from.norm();
    const Named named = namedOf(name);
    const std::string direction = directionInWords(from);
    if (nearest < kAt) {
      words = "at the " + named.whole();
    } else if (!named.aspect.empty() && (direction == "below" || direction == "above")) {
      words = fmt::format("{}, {} {} the {}", named.aspect, distanceInWords(nearest), direction,
                          named.part);
    } else {
      words = fmt::format("{} {} the {}", distanceInWords(nearest), direction, named.whole());
    }
  }
  return nearest < kFar ? words : "";
}

std::string curveInWords(const Design& design, const std::string& id) {
  if (id == "border") return "the border of the model";
  for (const StylingCurve& curve : design.curves) {
    if (curve.id == id) return '"' + (curve.name.empty() ? id : curve.name) + '"';
  }
  return '"' + id + '"';
}

double distanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double squared = (b - a).squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
  return (a + t * (b - a) - p).norm();
}

std::string byEdge(const Design& design, const Piece& piece, const FlatPiece& flat,
                   VertexId vertex) {
  const Vector2d place = flat.position[vertex];
  double nearest = std::numeric_limits<double>::infinity();
  std::string curve;
  double low = place.y(), high = place.y();
  for (const Wire& wire : piece.wires) {
    if (!isBoundary(wire.kind)) continue;
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const Vector2d& a = flat.position[wire.vertices[i]];
      low = std::min(low, a.y());
      high = std::max(high, a.y());
      const double distance = distanceToSegment(place, a, flat.position[wire.vertices[i + 1]]);
      if (distance >= nearest) continue;
      nearest = distance;
      curve = wire.curve;
    }
  }
  const double height = high > low ? (place.y() - low) / (high - low) : 0.5;
  const char* third = height > 2.0 / 3 ? "upper" : height < 1.0 / 3 ? "lower" : "middle";
  const std::string name = curveInWords(design, curve);
  return nearest < 1
             ? fmt::format("on {}, in the {} third", name, third)
             : fmt::format("{} from {}, in the {} third", distanceInWords(nearest), name, third);
}

}  // namespace

std::string nameInWords(const std::string& name) {
  return namedOf(name).whole();
}

std::string placeInWords(const Document& document, const Piece& piece, const FlatPiece& flat,
                         VertexId vertex) {
  const std::string words = byLandmark(*document.model, piece.mesh->position(vertex));
  return words.empty() ? byEdge(*document.design, piece, flat, vertex) : words;
}

std::string describe(const StrainSpot& spot) {
  std::string words = fmt::format("{:.1f} % ", 100 * std::abs(spot.value));
  if (spot.kind == StrainKind::Shear) {
    words += "shear";
  } else {
    words += spot.value > 0 ? "stretch" : "too much cloth";
    words += spot.kind == StrainKind::Along ? " along the grain" : " across the grain";
  }
  if (spot.isOverLimit()) words += fmt::format(", over the limit of {:g} %", 100 * *spot.limit);
  return words;
}

}  // namespace toile
