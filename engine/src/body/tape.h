// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "body/subdivision.h"
#include "toile/body/body.h"

namespace toile::body {

/// mm, in the order of BodyMeasure.
using Measures = std::array<double, kBodyMeasureCount>;

/// Takes all measures of a body from the few vertices that they run through.
class Tape {
 public:
  Tape();
  /// Vertices of the refined net that are needed, ascending.
  [[nodiscard]] const std::vector<std::size_t>& vertices() const { return vertices_; }
  /// @param places one row per vertex of vertices()
  [[nodiscard]] Measures measure(const Points& places) const;
  /// Straight from the cage of the surface.
  [[nodiscard]] Measures measureCage(const Points& cage) const { return measure(weights_ * cage); }

 private:
  struct Line {
    std::vector<Eigen::Index> rows;
    bool closed = false;
  };
  [[nodiscard]] Eigen::Index row(std::size_t vertex) const;
  [[nodiscard]] double length(const Line& line, const Points& places) const;

  std::vector<std::size_t> vertices_;
  SparseRows weights_;
  std::vector<Line> lines_;         ///< by measure; empty where it is no line
  std::vector<Eigen::Index> foot_;  ///< rows of the left foot
  Eigen::Index crown_ = 0, crotch_ = 0;
};

/// The one tape.
const Tape& tape();

}  // namespace toile::body
