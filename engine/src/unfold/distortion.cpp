// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/check.h"
#include "unfold/triangle_energy.h"

namespace toile::unfolding {

FaceData<FaceDistortion> computeDistortion(const Problem& problem, const Plane& q) {
  FaceData<FaceDistortion> distortion(problem.triangles.size());
  for (std::size_t i = 0; i < problem.triangles.size(); ++i) {
    const auto [s1, s2] = singularValues(mapOf(problem.triangles[i], q));
    distortion[FaceId(i)] = {s1, s2};
  }
  return distortion;
}

}  // namespace toile::unfolding
