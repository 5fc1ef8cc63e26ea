// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/curve/curvature.h"
#include "toile/edit/edited.h"

namespace toile {

/// Along the surface.
Result<Length> curveLength(const Document& document, const std::string& curve);
/// Of a stretch, in its direction.
Result<Length> stretchLength(const Document& document, const std::string& curve,
                             const Stretch& stretch);
/// The straightened way between two points over the surface (curve/geodesic.h): the shortest of all
/// between near points, a locally shortest one between far.
Result<Length> surfaceDistance(const ReferenceModel& model, const SurfacePoint& a,
                               const SurfacePoint& b);
/// The girth through a point: the loop that passes it of the section square to the normal.
Result<Length> girthThrough(const ReferenceModel& model, const SurfacePoint& point,
                            const Eigen::Vector3d& normal);

/// A place where two curves meet.
struct CurveMeeting {
  double atFirst = 0, atSecond = 0;  ///< fractions
  SurfacePoint point;
  Angle angle;  ///< between their directions on the surface, 0..180 degrees
};
Result<std::vector<CurveMeeting>> meetingsOf(const Document& document, const std::string& first,
                                             const std::string& second);

/// Even samples of a curve with its geodesic curvature: a comb to judge it by.
Result<std::vector<CurvatureSample>> curvatureOf(const Document& document, const std::string& curve,
                                                 std::size_t samples);

}  // namespace toile
