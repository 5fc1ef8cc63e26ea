// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "toile/mesh/surface_index.h"

namespace toile {

/// A camera: where a drawing on the screen was made. Screen x right, y up, origin at the centre.
struct View {
  Eigen::Vector3d eye{0, -3000, 1000};  ///< mm
  Eigen::Vector3d target{0, 0, 1000};   ///< mm
  Eigen::Vector3d up{0, 0, 1};
  double height = 2000;     ///< mm seen from bottom to top, at the target
  bool perspective = true;  ///< otherwise parallel rays
  friend bool operator==(const View&, const View&) = default;
};

/// The ray through a point of the view plane (mm at the target's depth).
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};
[[nodiscard]] Ray rayThrough(const View& view, const Eigen::Vector2d& point);

/// Puts a row of view-plane points on the surface: the first hit that faces the viewer.
///
/// @return the surface points; LeavesSilhouette when a ray misses the model (message says which and
///   how many), CurveInvalid when consecutive hits lie on parts far from each other on the surface
///   (the curve would jump to another limb).
Result<std::vector<SurfacePoint>> projectFromView(const SurfaceIndex& index, const View& view,
                                                  std::span<const Eigen::Vector2d> points);

/// A stretch of a drawn row that lies on one part of the model.
struct ViewRun {
  std::vector<SurfacePoint> points;
  double from = 0;  ///< where it begins in the row: the index of a point, or between two
  double to = 0;
};

/// Why a drawn row was cut.
struct ViewCut {
  enum class Reason {
    Silhouette,  ///< the drawing leaves the outline of the model, or comes onto it
    OtherPart    ///< it passes to a part of the model that does not hang together with the last
  };
  Reason reason = Reason::Silhouette;
  Eigen::Vector2d where;  ///< mm in the view
};

struct ViewProjection {
  std::vector<ViewRun> runs;  ///< of two points and more, in the order of the row
  std::vector<ViewCut> cuts;
};

/// Puts a drawn row on the surface as far as it can be seen: where it leaves the outline, or passes
/// in front of another limb, it is cut (as near there as 1/1000 of the step between its points);
/// no run ever jumps.
ViewProjection projectRunsFromView(const SurfaceIndex& index, const View& view,
                                   std::span<const Eigen::Vector2d> points);

}  // namespace toile
