// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "toile/unfold/symmetrise.h"
#include "unfold/block_matrix.h"
#include "unfold/problem.h"
#include "unfold/sparse_factor.h"

namespace toile::unfolding {

struct MirrorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;
};

/// The plane in which a piece is nearly its own mirror image.
/// @param tolerance greatest distance of outline, inner wires and surface from their image, as a
///   share of the root of the area.
/// @return nothing for a piece that is not symmetric or cannot lie flat.
[[nodiscard]] std::optional<MirrorPlane> findMirrorPlane(const Piece& piece, double tolerance);

/// An outline beside its mirror image.
struct OutlineSymmetry {
  double asymmetry = 0;  ///< mm: greatest distance of the outline from its mirror image
  /// Places on edges of the outline at which the other side has a vertex and this one has none.
  struct Point {
    VertexId from, to;
    double t = 0;  ///< 0 < t < 1, from `from`
  };
  std::vector<Point> missing;
  PieceSymmetry symmetry;  ///< when nothing is missing
};

/// An axis or a point of the other side this near to a vertex, as a share of the edges there, is
/// the vertex: no slivers.
inline constexpr double kSameVertex = 0.02;

/// @param tolerance as for findMirrorPlane()
/// @return nothing for a piece that is not symmetric in this plane or cannot lie flat.
[[nodiscard]] std::optional<OutlineSymmetry> compareHalves(const Piece& piece,
                                                           const MirrorPlane& plane,
                                                           double tolerance,
                                                           double sameVertex = kSameVertex);

[[nodiscard]] MirrorTies tiesOf(const PieceSymmetry& symmetry, std::size_t vertexCount);

/// The symmetry of a piece that is its own mirror image to rounding: outline with its points and
/// targets, inner wires; its surface may be meshed in another way.
[[nodiscard]] std::optional<PieceSymmetry> findExactSymmetry(const Piece& piece,
                                                             const Problem& problem);

/// Turns the plane so that the axis is x = 0 at best, then moves each pair to the mean of itself
/// and its mirror image.
void makeSymmetric(const PieceSymmetry& symmetry, Plane& q);

/// A placement without folds whose paired vertices are mirror images in x = 0, to the last bit.
/// @param pattern with the ties of the symmetry.
/// @return NotConverged when none was found.
[[nodiscard]] Result<Plane> symmetricStart(const Problem& problem,
                                           const std::vector<Eigen::Vector3d>& positions,
                                           const PieceSymmetry& symmetry,
                                           const BlockPattern& pattern, SparseFactor& factor);

}  // namespace toile::unfolding
