// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "layout/placed_piece.h"

namespace toile {

using Eigen::Vector2d;

Placement composed(const Placement& second, const Placement& first) {
  return {second.angle + first.angle, second.apply(first.offset)};
}

Placement inverse(const Placement& placement) {
  Placement back{-placement.angle, Vector2d::Zero()};
  back.offset = -back.applyToDirection(placement.offset);
  return back;
}

void PlacedPiece::move(const Placement& by) {
  placement = composed(by, placement);
  for (Vector2d& p : cut) p = by.apply(p);
  for (Vector2d& p : grownBy) p = by.apply(p);
}

void PlacedPiece::shift(const Vector2d& by) {
  placement.offset += by;
  for (Vector2d& p : cut) p += by;
  for (Vector2d& p : grownBy) p += by;
}

PlaceOnMap placeOnMap(const Piece& piece, const FlatPiece& flat, const Mesh& model,
                      const GuidingMap& map) {
  const Mesh& mesh = *piece.mesh;
  std::vector<double> areaOn(map.charts.size(), 0);
  for (std::size_t i = 0; i < mesh.faceCount(); ++i)
    areaOn[map.chartOf[piece.sourceFace[FaceId(i)]]] += mesh.area(FaceId(i));
  // Only clearly more counts, so that left and right, equal but for rounding, take the same chart.
  constexpr double kClearly = 1.02;
  PlaceOnMap place;
  for (std::uint32_t c = 1; c < areaOn.size(); ++c)
    if (areaOn[c] > kClearly * areaOn[place.chart]) place.chart = c;

  // Subscript m = on the map. The best turn maximises the sum of w (R p) . m:
  // R = the rotation by atan2(sum w p x m, sum w p . m), both about their centroids.
  struct Pair {
    Vector2d p, m;
    double w;
  };
  std::vector<Pair> pairs;
  Vector2d centre = Vector2d::Zero();
  Vector2d centreOnMap = Vector2d::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const FaceId face(i);
    const FaceId source = piece.sourceFace[face];
    if (map.chartOf[source] != place.chart) continue;
    const double w = mesh.area(face) / 3;
    for (const VertexId v : mesh.vertices(face)) {
      const Pair pair{flat.position[v], map.place(model, piece.onModel[v], source), w};
      centre += w * pair.p;
      centreOnMap += w * pair.m;
      sum += w;
      pairs.push_back(pair);
    }
  }
  if (sum <= 0) return place;
  centre /= sum;
  centreOnMap /= sum;
  double dot = 0;
  double turn = 0;
  double spread = 0;
  for (const Pair& pair : pairs) {
    const Vector2d p = pair.p - centre;
    const Vector2d m = pair.m - centreOnMap;
    dot += pair.w * p.dot(m);
    turn += pair.w * cross(p, m);
    spread += pair.w * p.squaredNorm();
  }
  // A piece that goes all round says nothing about its turn: its own up stays up.
  if (std::hypot(dot, turn) > 1e-3 * spread) place.placement.angle = std::atan2(turn, dot);
  place.placement.offset = centreOnMap - place.placement.applyToDirection(centre);
  return place;
}

}  // namespace toile
