// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout/guiding_map.h"

#include <cmath>

#include "finish/polygon.h"

namespace toile {

ChartPlace placeOnChart(const Piece& piece, const FlatPiece& flat) {
  const Mesh& mesh = *piece.mesh;
  std::vector<double> weight(mesh.vertexCount(), 0);
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();
  double area = 0;
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const FaceId f(i);
    const double a = mesh.area(f);
    area += a;
    facing += a * mesh.normal(f);
    for (const VertexId v : mesh.vertices(f)) weight[v.index()] += a / 3;
  }
  ChartPlace place;
  // Off zero, so that left and right side panels, equal but for rounding, go to the same chart.
  constexpr double kBackward = 0.05;
  if (facing.y() > kBackward * area) place.chart = Chart::Back;
  const double mirror = place.chart == Chart::Back ? -1 : 1;

  // Subscript m = on the map. The best turn maximises the sum of w (R p) . m:
  // R = the rotation by atan2(sum w p x m, sum w p . m), both about their centroids.
  const auto onMap = [&](std::size_t i) {
    const Eigen::Vector3d& p = mesh.position(VertexId(i));
    return Eigen::Vector2d(mirror * p.x(), p.z());
  };
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d centreOnMap = Eigen::Vector2d::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    centre += weight[i] * flat.position[VertexId(i)];
    centreOnMap += weight[i] * onMap(i);
    sum += weight[i];
  }
  if (sum <= 0) return place;
  centre /= sum;
  centreOnMap /= sum;
  double dot = 0;
  double turn = 0;
  double spread = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const Eigen::Vector2d p = flat.position[VertexId(i)] - centre;
    const Eigen::Vector2d m = onMap(i) - centreOnMap;
    dot += weight[i] * p.dot(m);
    turn += weight[i] * cross(p, m);
    spread += weight[i] * p.squaredNorm();
  }
  // A piece seen edge-on or all round says nothing about its turn: its own up stays up.
  if (std::hypot(dot, turn) > 1e-3 * spread) place.placement.angle = std::atan2(turn, dot);
  place.placement.offset = centreOnMap - place.placement.applyToDirection(centre);
  return place;
}

}  // namespace toile
