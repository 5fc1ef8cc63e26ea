// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "toile/unfold/symmetrise.h"
#include "unfold/solution.h"
#include "unfold/sparse_factor.h"
#include "unfold/triangle_energy.h"
#include "unfold/wire_bending.h"
#include "unfold/wire_stiffness.h"

namespace toile::unfolding {

/// Which nodes of the plane any objective couples.
/// @param ties of the vertices, empty for none.
/// @param more pairs of vertices to couple.
[[nodiscard]] BlockPattern couplingsOf(
    const Problem& problem, MirrorTies ties = {},
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& more = {});

/// A placement without folds to begin with: conformal, or on a circle where that folds.
/// @return NotConverged when neither is without folds.
[[nodiscard]] Result<Plane> unfoldedStart(const Problem& problem,
                                          const std::vector<Eigen::Vector3d>& positions,
                                          std::pair<std::uint32_t, std::uint32_t> hold,
                                          const BlockPattern& pattern, SparseFactor& factor);

/// Least strain with exact lengths for one connectivity: pattern and order of elimination are kept
/// from call to call.
class LeastStrain {
 public:
  /// @param problem stays where it is; its numbers may change between calls, its connectivity not.
  /// @param symmetry vertices that shall be mirror images of each other; null for none.
  LeastStrain(const Problem& problem, const UnfoldOptions& options,
              const PieceSymmetry* symmetry = nullptr);

  /// The full answer; no history.
  [[nodiscard]] Result<Solution> solve(const Piece& piece, Progress* progress);
  /// A few steps from where the last call ended, or from the start at the first.
  [[nodiscard]] Result<Solution> preview(const Piece& piece, Progress* progress);

 private:
  [[nodiscard]] Result<void> start(const Piece& piece);
  const Problem* problem_;
  UnfoldOptions options_;
  const PieceSymmetry* symmetry_;
  BlockPattern pattern_;
  SparseFactor factor_;
  std::unique_ptr<TriangleEnergy> strain_;
  WireLengths lengths_;
  std::optional<WireBending> bending_;
  WireStiffness stiffness_;
  std::optional<ConstrainedNewton> newton_;
  Solution solution_;
};

}  // namespace toile::unfolding
