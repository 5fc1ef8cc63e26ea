// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/start.h"

#include <cmath>

#include "unfold/triangle_energy.h"

namespace toile::unfolding {

std::pair<std::uint32_t, std::uint32_t> farBoundaryPair(
    const Problem& problem, const std::vector<Eigen::Vector3d>& positions) {
  const std::vector<std::uint32_t>& loop = problem.loops[problem.outerLoop];
  // The loop begins where the numbering says; farthest of farthest depends on the shape alone but
  // for ties.
  const auto farthestFrom = [&](std::uint32_t from) {
    std::uint32_t best = loop.front() == from ? loop.back() : loop.front();
    for (const std::uint32_t v : loop) {
      if ((positions[v] - positions[from]).squaredNorm() >
          (positions[best] - positions[from]).squaredNorm()) {
        best = v;
      }
    }
    return best;
  };
  const std::uint32_t first = farthestFrom(loop.front());
  return {first, farthestFrom(first)};
}

void scaleToLeastStrain(const Problem& problem, Plane& q) {
  double direct = 0;
  double inverse = 0;
  for (const RestTriangle& t : problem.triangles) {
    const auto [s1, s2] = singularValues(mapOf(t, q));
    if (!(s2 > 1e-12 * s1)) continue;
    direct += t.area * (s1 * s1 + s2 * s2);
    inverse += t.area * (1 / (s1 * s1) + 1 / (s2 * s2));
  }
  if (direct > 0 && inverse > 0) q *= std::pow(inverse / direct, 0.25);
}

std::size_t flippedCount(const Problem& problem, const Plane& q) {
  std::size_t count = 0;
  for (const RestTriangle& t : problem.triangles) {
    const PlaneMap f = mapOf(t, q);
    if (!(f.determinant() > 0) || !(singularValues(f)[1] > 0)) ++count;
  }
  return count;
}

}  // namespace toile::unfolding
