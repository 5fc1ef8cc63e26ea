// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <map>
#include <utility>
#include <vector>

#include "body/control_net.h"

namespace toile::body {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Catmull-Clark surface of the control net, twice refined, its vertices on the limit surface.
///
/// It passes through its control points: the weights below already hold the inverse of the limit
/// rule. Vertices of the net keep their index in the refined net.
/// @see Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological
/// meshes", CAD 10(6), 1978; Halstead, Kass, DeRose, "Efficient, fair interpolation using
/// Catmull-Clark surfaces", SIGGRAPH 1993 (limit positions, interpolation).
class Subdivision {
 public:
  explicit Subdivision(const ControlNet& net);

  [[nodiscard]] std::size_t vertexCount() const { return partner_.size(); }
  /// Counter-clockwise from outside; the four of each quad of the refinement before follow each
  /// other, the first with the corner that the quad named first.
  [[nodiscard]] const std::vector<std::array<std::size_t, 4>>& quads() const { return quads_; }
  [[nodiscard]] const std::vector<std::size_t>& partner() const { return partner_; }

  /// The control cage of the surface that passes through the control points.
  [[nodiscard]] Points cageThrough(const Points& controlPoints) const;
  /// Rows: refined vertices; columns: vertices of the cage.
  [[nodiscard]] const SparseRows& weights() const { return weights_; }

  /// The five refined vertices on an edge of the net, from one end to the other.
  [[nodiscard]] std::array<std::size_t, 5> alongEdge(NetVertex from, NetVertex to) const;

 private:
  using Edge = std::pair<std::size_t, std::size_t>;
  using EdgePoints = std::map<Edge, std::size_t>;

  std::vector<std::array<std::size_t, 4>> quads_;
  std::vector<std::size_t> partner_;
  SparseRows weights_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> interpolation_;
  std::vector<EdgePoints> edgePoints_;  ///< per refinement
};

/// The one of controlNet().
const Subdivision& subdivision();

}  // namespace toile::body
