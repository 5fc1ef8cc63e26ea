// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "toile/unfold/unfold.h"
#include "unfold/constrained_newton.h"

namespace toile::unfolding {

/// What a solver found, and what is worth telling of it.
struct Solution {
  NewtonState state;
  double wireStiffness = 0;              ///< of the stiffest
  std::vector<std::uint32_t> stiffened;  ///< wires with more than the options'; kNoWire = border
  double buckling = 0;                   ///< highest compression as a share of the buckling load
  bool finished = true;
  bool stable = true;
  double wireBending = 0;  ///< J
  double meanEnergy = 0;   ///< per area, of the strain alone
  ElasticModel elastic;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings;
  /// Where everything would lie without edges that push each other apart; empty if they need not.
  Plane overlapping;
};

[[nodiscard]] std::vector<Finding> makeFindings(const Piece& piece, const Problem& problem,
                                                const UnfoldOptions& options,
                                                const Solution& solution, const FlatPiece& flat);

/// LengthsInfeasible, with the wires of the greatest length errors: curves first, then edges.
[[nodiscard]] Error infeasible(const Piece& piece, const Problem& problem, const NewtonState& state,
                               const WireLengths& lengths);

}  // namespace toile::unfolding
