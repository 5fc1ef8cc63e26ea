// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile {
namespace cutting {

std::vector<LoopTurning> measureLoops(const Mesh& mesh) {
  std::vector<LoopTurning> loops;
  for (std::vector<HalfedgeId>& loop : mesh.boundaryLoops()) {
    double turning = 0;
    for (const HalfedgeId h : loop) {
      double angle = 0;
      const VertexId v = mesh.from(h);
      for (const FaceId f : mesh.facesAround(v)) {
        const Triangle& corners = mesh.vertices(f);
        const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) -
                                                corners.begin());
        const Eigen::Vector3d a = mesh.position(corners[(k + 1) % 3]) - mesh.position(v);
        const Eigen::Vector3d b = mesh.position(corners[(k + 2) % 3]) - mesh.position(v);
        angle += std::atan2(a.cross(b).norm(), a.dot(b));
      }
      turning += std::numbers::pi - angle;
    }
    loops.push_back({std::move(loop), turning, false});
  }
  if (loops.size() < 2) return loops;
  const auto outer = std::max_element(
      loops.begin(), loops.end(),
      [](const LoopTurning& l, const LoopTurning& r) { return l.turning < r.turning; });
  if (outer->turning < std::numbers::pi) return loops;
  for (LoopTurning& loop : loops) loop.isHole = loop.turning < -std::numbers::pi;
  return loops;
}

}  // namespace cutting

PieceTopology topology(const Piece& piece) {
  const std::vector<cutting::LoopTurning> loops = cutting::measureLoops(*piece.mesh);
  PieceTopology result;
  result.boundaryLoops = loops.size();
  result.eulerCharacteristic = piece.mesh->eulerCharacteristic();
  result.holes = static_cast<std::size_t>(
      std::count_if(loops.begin(), loops.end(), [](const auto& loop) { return loop.isHole; }));
  return result;
}

}  // namespace toile
