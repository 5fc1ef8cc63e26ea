// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "toile/core/result.h"
#include "toile/cut/cut.h"

namespace toile::unfolding {

/// Positions in the plane, mm: x0, y0, x1, y1, ...
using Plane = Eigen::VectorXd;

[[nodiscard]] inline Eigen::Vector2d at(const Plane& q, std::uint32_t v) {
  return {q[2 * Eigen::Index{v}], q[2 * Eigen::Index{v} + 1]};
}

/// A triangle in its own 3D plane. The map to the 2D plane is F = sum_k q_k hatGradient_k^T.
struct RestTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<Eigen::Vector2d, 3> hatGradient;  ///< 1/mm; x runs along the side 0 -> 1
  double area = 0;                             ///< mm^2
};

/// An edge whose flat length is given.
struct WireEdge {
  std::uint32_t a = 0, b = 0;
  double target = 0;                ///< mm
  std::uint32_t wire = kNoWire;     ///< index in Piece::wires
  std::uint32_t edgeOfWire = 0;     ///< index in that wire
  bool inner = false;               ///< cloth on both sides
  std::uint32_t elastic = kNoWire;  ///< index in Problem::elastics
  static constexpr std::uint32_t kNoWire = 0xffffffffU;
};

/// The angle of cloth between two wire edges that follow each other around a wire vertex, counted
/// counter-clockwise from `before` to `after`. One per directed wire edge, but for the tip of a
/// wire that ends in the cloth: its angle is 2 pi whatever happens.
struct Corner {
  std::uint32_t before = 0, at = 0, after = 0;
  double alpha = 0;                              ///< on the surface, radians
  double span = 0;                               ///< mm of wire that the corner stands for
  std::uint32_t sectorBegin = 0, sectorEnd = 0;  ///< its face corners, in Problem::sectorCorners
};

/// A line whose edges all get 1 + ratio times their targets, |ratio| <= range.
struct Elastic {
  std::string curve;
  double range = 0;
};

/// A piece as numbers: what every objective, start and check works on.
struct Problem {
  std::size_t vertexCount = 0;
  std::vector<RestTriangle> triangles;
  /// Unit direction of the warp in each triangle's plane; empty for cloth alike in all directions.
  std::vector<Eigen::Vector2d> grain;
  std::vector<WireEdge> wireEdges;
  std::vector<Elastic> elastics;
  std::vector<Corner> corners;
  std::vector<std::uint32_t> sectorCorners;       ///< 3 * triangle + corner of the triangle
  std::vector<std::vector<std::uint32_t>> loops;  ///< boundary vertices, cloth on the left
  std::size_t outerLoop = 0;
  double area = 0;          ///< mm^2, on the surface
  double meanWireEdge = 0;  ///< mm
};

/// @return NotADisk, DegenerateFace, InvalidArgument (a wire that does not run along the mesh, a
///   target that is not a positive number).
Result<Problem> makeProblem(const Piece& piece);

/// Gives the edges of elastic lines the targets that the ratios mean; nothing is elastic any more.
void fixElastics(const Eigen::VectorXd& ratios, Problem& problem);

}  // namespace toile::unfolding
