// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fit/placement.h"
#include "fit/target.h"
#include "fit/untangle.h"
#include "toile/fit/fit.h"

namespace toile::fitting {

struct Judged {
  const Mesh& mesh;  ///< the fit
  const Target& target;
  const Placement& placement;
  const Expectation& expected;
  const std::vector<std::uint32_t>& regionOfVertex;  ///< or empty
  const FitLimits& limits;
  bool hasMittens = false;  ///< fingers that stick out of the hands are nothing to tell
};

/// Distances, turned and crossing faces, and whether they keep the limits.
[[nodiscard]] FitReport judge(const Judged& fit);

[[nodiscard]] DistanceSummary summarise(const std::vector<double>& distances,
                                        const std::vector<double>& weights);

}  // namespace toile::fitting
