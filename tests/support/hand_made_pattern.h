// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile::test {

/// A planar piece with known numbers: cells of a lattice in the plane y = 0 that faces the front
/// (-y); (u, v) lies at (u, 0, v) on the model and at (u, v) in the flat piece.
struct HandMadePiece {
  std::string id;
  /// Whether the lattice cell with its middle at (u, v) belongs to the piece.
  std::function<bool(double u, double v)> holds;
  /// Kind and curve of the boundary edge with its middle at (u, v).
  std::function<std::pair<WireKind, std::string>(double u, double v)> edge;
  /// Besides changes of the curve, boundary wires end where this is true.
  std::function<bool(double u, double v)> isJunction;
  /// Polylines of inner wires along lattice lines, ends included: curve, points.
  std::vector<std::pair<std::string, std::vector<Eigen::Vector2d>>> features;
};

inline constexpr double kLatticeMm = 20;

/// Cells inside [0, width] x [0, height].
Piece makeHandMadePiece(const HandMadePiece& plan, double width, double height);
/// The plane (x, z) of a hand-made piece, unchanged.
FlatPiece flatOf(const Piece& piece);

/// Two front pieces sewn along x = 300, 0 <= z <= 200 (seam "side", drawn upwards):
///   "ell"   the L shape (0,0) (300,0) (300,200) (120,200) (120,400) (0,400), with the feature
///           "waist" at z = 100 running through both pieces,
///   "panel" the rectangle 300..500 x 0..200.
/// Everything else is the model's border. Allowance 10 mm; 6 mm on the right of "side" (the panel).
Pattern makeTwoPiecePattern(double allowanceMm = 10);

}  // namespace toile::test
