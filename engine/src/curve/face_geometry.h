// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::detail {

/// The shape of the faces of a mesh as unfolding needs it, worked out when a face is first asked
/// for.
class FaceGeometry {
 public:
  explicit FaceGeometry(const Mesh& mesh) : mesh_(mesh), faces_(mesh.faceCount()) {}

  /// Where the third corner of the halfedge's face lies, on its left: from + along * d + aside * n
  /// with d = to - from in the plane and n = d turned left by 90 degrees.
  struct Apex {
    double along = 0, aside = 0;
  };
  const Apex& apex(HalfedgeId h) { return face(h).apex[h.index() % 3]; }
  /// Angle of the halfedge's face at the vertex that the halfedge leaves.
  double cornerAngle(HalfedgeId h) { return face(h).angle[h.index() % 3]; }
  /// Sum of the corner angles around the vertex.
  double angleAround(VertexId v);

 private:
  struct Face {
    bool isKnown = false;
    std::array<Apex, 3> apex;
    std::array<double, 3> angle;
  };
  const Face& face(HalfedgeId h) {
    Face& entry = faces_[h.index() / 3];
    if (!entry.isKnown) measure(mesh_.face(h), entry);
    return entry;
  }
  void measure(FaceId f, Face& entry) const;

  const Mesh& mesh_;
  std::vector<Face> faces_;
};

}  // namespace toile::detail
