// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "toile/mesh/surface_point.h"

namespace toile::test {

/// Random points of a mesh from a seed, the same on every system: a quarter each on vertices and
/// edges, the rest inside faces.
class SurfaceRandom {
 public:
  SurfaceRandom(const Mesh& mesh, unsigned seed) : mesh_(mesh), random_(seed) {}

  /// 0 <= number < 1.
  double number() { return static_cast<double>(random_()) / 4294967296.0; }
  std::size_t below(std::size_t count) { return random_() % count; }

  SurfacePoint point() {
    switch (below(4)) {
      case 0:
        return {VertexId(below(mesh_.vertexCount()))};
      case 1:
        return {SurfacePoint::OnEdge{EdgeId(below(mesh_.edgeCount())), 0.01 + 0.98 * number()}};
      default:
        return inFace(FaceId(below(mesh_.faceCount())));
    }
  }
  SurfacePoint inFace(FaceId face) {
    const double a = 0.01 + number(), b = 0.01 + number(), c = 0.01 + number();
    return makeSurfacePoint(mesh_, face, {a, b, c});
  }
  /// Inside a face or on an edge, about `part` of its size from a corner.
  SurfacePoint pointNearCorner(double part) {
    Eigen::Vector3d weights(0.5 * part, (1 + number()) * part, 0);
    if (below(2) == 0) weights[0] = 0;
    weights[2] = 1 - weights[0] - weights[1];
    const auto turn = static_cast<Eigen::Index>(below(3));
    return makeSurfacePoint(mesh_, FaceId(below(mesh_.faceCount())),
                            {weights[turn], weights[(turn + 1) % 3], weights[(turn + 2) % 3]});
  }

 private:
  const Mesh& mesh_;
  std::mt19937 random_;
};

}  // namespace toile::test
