// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "fit/graph.h"
#include "fit/surface.h"
#include "fit/target.h"
#include "toile/core/progress.h"

namespace toile::fitting {

/// A place on the template and where it should come to lie.
struct Pin {
  std::array<std::uint32_t, 3> vertices{};
  Eigen::Vector3d weights = Eigen::Vector3d::UnitX();
  Eigen::Vector3d place;
  double weight = 1;                                    ///< against the whole of the scan
  std::optional<Eigen::Vector3d> along = std::nullopt;  ///< held in this unit direction alone
};

struct CoarseProblem {
  Graph graph;
  Shape rest;  ///< in the scan's place and size
  /// What each member of the family adds to the rest shape, per vertex.
  std::vector<std::vector<Eigen::Vector3d>> family;
  std::vector<Pin> pins;
};

/// How stiff a fit begins and ends, and how many rounds each of these stiffnesses takes.
struct CoarseSchedule {
  std::size_t first = 0, end = 6;
  int rounds = 3;
};

struct CoarseFit {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Matrix3d> linear;  ///< per node
  std::vector<double> coefficients;     ///< of the family
};

/// Affine maps of the graph's nodes and a mix of the family together, by alternating nearest points
/// and one linear solve, from stiff to soft. Nothing when cancelled.
[[nodiscard]] std::optional<CoarseFit> fitCoarse(const std::vector<Triangle>& triangles,
                                                 const CoarseProblem& problem, const Target& target,
                                                 const CoarseSchedule& schedule,
                                                 Progress* progress);

}  // namespace toile::fitting
