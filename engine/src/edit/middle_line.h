// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "toile/model/reference_model.h"

namespace toile::detail {

/// The points of a model that are their own mirror images, as segments. With a pairing of vertices:
/// edges between vertices that are their own partners, and the middles of faces that are their own
/// images; else the section with the mirror plane.
class MiddleLine {
 public:
  explicit MiddleLine(const ReferenceModel& model);
  [[nodiscard]] bool empty() const { return segments_.empty(); }
  /// The nearest point of the line.
  [[nodiscard]] SurfacePoint nearest(const Mesh& mesh, const Eigen::Vector3d& place) const;

 private:
  struct Segment {
    FaceId face;
    SurfacePoint a, b;
  };
  std::vector<Segment> segments_;
};

/// > 0 on the model's left, < 0 on its right; with a pairing by where the vertices' partners lie.
[[nodiscard]] double sideOf(const ReferenceModel& model, const SurfacePoint& point);

/// A step from a point of the middle line over the surface, towards a place, square to the line: it
/// and its mirror image go straight into each other. With a pairing of vertices by the angles on
/// the surface, else square to the mirror plane.
/// @return nullopt where the border leaves no room for it
[[nodiscard]] std::optional<SurfacePoint> stepSquare(const ReferenceModel& model,
                                                     const SurfacePoint& from,
                                                     const Eigen::Vector3d& towards, double length);

/// The point is its own mirror image.
[[nodiscard]] bool isOnMiddle(const ReferenceModel& model, const SurfacePoint& point);

}  // namespace toile::detail
