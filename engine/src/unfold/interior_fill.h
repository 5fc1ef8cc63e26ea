// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/core/progress.h"
#include "toile/core/result.h"
#include "unfold/sparse_factor.h"
#include "unfold/triangle_energy.h"

namespace toile::unfolding {

/// Fills the cloth in between wires whose places are given: from a plane without folds the wires
/// are pulled to their places by springs that get stiffer, and the cloth follows with the least
/// strain and without folding. Where no such plane exists the wires stop short of their places.
class InteriorFill {
 public:
  static constexpr int kRounds = 5;

  InteriorFill(const Problem& problem, const BlockPattern& pattern, SparseFactor& factor,
               const UnfoldOptions& options);
  /// @param q a plane without folds; moved.
  /// @param places of `vertices`, two numbers each.
  [[nodiscard]] Result<void> pullTo(Plane& q, const std::vector<std::uint32_t>& vertices,
                                    const Plane& places, int round, const Progress* progress);
  /// Strain energy per area; infinite where a triangle is flipped.
  [[nodiscard]] double meanEnergy(const Plane& q) const {
    return strain_->energy(q) / problem_->area;
  }

 private:
  const Problem* problem_;
  const BlockPattern* pattern_;
  SparseFactor* factor_;
  std::unique_ptr<TriangleEnergy> strain_;
  Problem withoutWires_;
};

}  // namespace toile::unfolding
