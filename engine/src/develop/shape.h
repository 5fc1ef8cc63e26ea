// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "develop/angle_sums.h"
#include "toile/develop/develop.h"

namespace toile::developing {

/// Why the processing ended.
enum class ShapeEnd { Developable, Rough, Turned, Stretched, Stuck, StepLimit, Cancelled };

struct Shape {
  Positions at;
  ShapeEnd end = ShapeEnd::Developable;
  int steps = 0;
};

/// The most developable shape that the processing reaches from the mesh, border fixed.
[[nodiscard]] Shape findDevelopableShape(const Mesh& mesh, const DevelopOptions& options,
                                         const Progress* progress);

/// Signed distance of a place to a surface, > 0 outside; mm.
[[nodiscard]] double signedDistance(const SurfaceIndex& surface, const Eigen::Vector3d& place);

/// Moves every inner vertex that is nearer than `gap` to the surface out to it.
void pushOutside(const Mesh& mesh, const SurfaceIndex& surface, double gap, Positions& at);

}  // namespace toile::developing
