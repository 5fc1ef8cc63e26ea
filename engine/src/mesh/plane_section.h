// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/mesh/surface_point.h"

namespace toile::detail {

/// See SurfaceIndex::planeSection(); needs no index.
[[nodiscard]] std::vector<SurfacePath> computePlaneSection(const Mesh& mesh,
                                                           const Eigen::Vector3d& normal,
                                                           double offset);

}  // namespace toile::detail
