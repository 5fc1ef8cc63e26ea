// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/surface.h"
#include "fit/target.h"
#include "toile/core/progress.h"

namespace toile::fitting {

/// Moves every vertex along its normal onto the scan, as smoothly as the template's size of edge
/// asks; what the scan does not show follows its surroundings. Vertices at triangles that would
/// turn over keep their place. Nothing when cancelled.
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> fitFine(const Mesh& connectivity,
                                                                  const Shape& coarse,
                                                                  const Target& target,
                                                                  Progress* progress);

}  // namespace toile::fitting
