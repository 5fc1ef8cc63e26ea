// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/design/design.h"

namespace toile::detail {

/// The one loop that a section plane means. A closed loop runs counter-clockwise seen from the tip
/// of the normal and starts where the ray from its centroid to the front (-y, or +z when the normal
/// is nearly along y) leaves it last, so that fractions mean alike on bodies of different shape.
Result<SurfacePath> sectionLoop(const SectionPlane& plane, const ReferenceModel& model);

/// Where the ray from the loop's centroid along the direction, within the plane, leaves it last.
Result<SurfacePoint> pointOnLoop(const Mesh& mesh, const SurfacePath& loop,
                                 const Eigen::Vector3d& normal, const Eigen::Vector3d& direction);

/// NameNotFound, with the nearest name that exists.
Error nameNotFound(std::string_view what, const std::string& name,
                   const std::vector<std::string>& known);

}  // namespace toile::detail
