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
};

struct CoarseProblem {
  const std::vector<Triangle>& triangles;
  const Graph& graph;
  const Target& target;
  Shape rest;  ///< in the scan's place and size
  /// What each member of the family adds to the rest shape, per vertex.
  std::vector<std::vector<Eigen::Vector3d>> family;
  std::vector<Pin> pins;
  double pinScale = 1;  ///< 1 for exact pins
};

struct CoarseFit {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Matrix3d> linear;  ///< per node
  std::vector<double> coefficients;     ///< of the family
};

/// Affine maps of the graph's nodes and a mix of the family together, by alternating nearest points
/// and one linear solve, from stiff to soft. Nothing when cancelled.
[[nodiscard]] std::optional<CoarseFit> fitCoarse(const CoarseProblem& problem, Progress* progress);

}  // namespace toile::fitting
