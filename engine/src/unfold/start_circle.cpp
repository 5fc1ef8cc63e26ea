// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include "unfold/start.h"

namespace toile::unfolding {

std::optional<Plane> circleStart(const Problem& problem) {
  constexpr double kFree = -1;
  const std::vector<std::uint32_t>& rim = problem.loops[problem.outerLoop];

  // Places on the circle by arc length of the target lengths would need the wires in order; the
  // number of the edge serves as well and keeps neighbours apart.
  const std::size_t nodes = problem.vertexCount + problem.loops.size();
  std::vector<double> angle(nodes, kFree);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    angle[rim[i]] = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(rim.size());
  }

  // Every hole gets a node in its middle, so that the graph is triangulated.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const RestTriangle& t : problem.triangles) {
    for (std::size_t k = 0; k < 3; ++k) sides.emplace_back(t.vertex[k], t.vertex[(k + 1) % 3]);
  }
  for (std::size_t l = 0; l < problem.loops.size(); ++l) {
    if (l == problem.outerLoop) continue;
    for (const std::uint32_t v : problem.loops[l]) {
      sides.emplace_back(static_cast<std::uint32_t>(problem.vertexCount + l), v);
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> freePairs;
  for (const auto& [a, b] : sides) {
    if (angle[a] == kFree && angle[b] == kFree) freePairs.emplace_back(a, b);
  }
  const BlockPattern pattern(nodes, freePairs);
  BlockMatrix matrix(pattern);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(nodes));
  const auto onCircle = [&](std::uint32_t v) {
    return Eigen::Vector2d(std::cos(angle[v]), std::sin(angle[v]));
  };
  // Inner sides come twice, once per triangle, so that all free nodes see uniform weights.
  for (const auto& [a, b] : sides) {
    if (angle[a] == kFree) matrix.addDiagonal(a, 1, 0, 1);
    if (angle[b] == kFree) matrix.addDiagonal(b, 1, 0, 1);
    if (angle[a] == kFree && angle[b] == kFree) {
      matrix.add(pattern.find(a, b), -Eigen::Matrix2d::Identity());
    } else if (angle[a] == kFree) {
      force.segment<2>(2 * Eigen::Index{a}) += onCircle(b);
    } else if (angle[b] == kFree) {
      force.segment<2>(2 * Eigen::Index{b}) += onCircle(a);
    }
  }
  for (const std::uint32_t v : rim) {
    matrix.addDiagonal(v, 1, 0, 1);
    force.segment<2>(2 * Eigen::Index{v}) = onCircle(v);
  }
  matrix.addDiagonal(static_cast<std::uint32_t>(problem.vertexCount + problem.outerLoop), 1, 0, 1);

  SparseFactor factor(pattern);
  if (!factor.factor(matrix)) return std::nullopt;
  Plane q;
  factor.solve(force, q);
  q.conservativeResize(2 * static_cast<Eigen::Index>(problem.vertexCount));
  if (!q.allFinite()) return std::nullopt;
  scaleToLeastStrain(problem, q);
  return q;
}

}  // namespace toile::unfolding
