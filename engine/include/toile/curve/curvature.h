// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "toile/core/units.h"
#include "toile/mesh/surface_point.h"

namespace toile {

/// Unit normal of the surface as if it were smooth: the vertices' normals, weighted by corner
/// angles, blended by the point's weights.
[[nodiscard]] Eigen::Vector3d smoothNormal(const Mesh& mesh, const SurfacePoint& point);

/// A line at one place, as a designer judges it.
struct CurvatureSample {
  double arc = 0;  ///< mm from the start
  SurfacePoint point;
  Eigen::Vector3d position;
  Eigen::Vector3d normal;   ///< of the surface, smooth
  Eigen::Vector3d tangent;  ///< unit, in the surface
  double curvature = 0;     ///< geodesic, 1/mm: positive where the line turns to its left
};

/// Even samples of a path: count + 1 of an open one with both ends, count of a closed one. The
/// curvature at an open end is that of its neighbour. Precondition: count >= 3, path valid.
[[nodiscard]] std::vector<CurvatureSample> sampleCurvature(const Mesh& mesh,
                                                           const SurfacePath& path,
                                                           std::size_t count);

/// How restless a line is.
struct Restlessness {
  int inflections = 0;   ///< changes between bends to the left and to the right
  double variation = 0;  ///< total variation of geodesic curvature, 1/mm
};
/// @param leastBend a bend that turns the line by less does not count: noise of the mesh.
/// @param corners where the line turns sharply on purpose, mm along it: what is nearer than a step
///   of the samples does not count.
[[nodiscard]] Restlessness measureRestlessness(const std::vector<CurvatureSample>& samples,
                                               bool closed, Angle leastBend = Angle::degrees(3),
                                               std::span<const double> corners = {});

}  // namespace toile
