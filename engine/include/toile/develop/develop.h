// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/core/units.h"
#include "toile/mesh/surface_index.h"
#include "toile/unfold/unfold.h"

namespace toile {

struct DevelopOptions {
  /// t: 0 = the piece as it is, 1 = as developable as it can be made. Not looked at when
  /// `maxAreaError` is set.
  double amount = 1;  ///< 0..1
  /// Takes the smallest t whose unfolding has at most this mean area error.
  std::optional<Ratio> maxAreaError{};
  /// No vertex may come nearer to this surface than `gap`, seen from its outside.
  std::shared_ptr<const SurfaceIndex> outsideOf{};
  Length gap{};        ///< 0..1 m
  int maxSteps = 200;  ///< of the processing
  UnfoldOptions unfold{};
};

/// A wire inside the piece: its length moves with the surface.
struct FeatureChange {
  std::string curve;
  int part = 0;
  double before = 0;  ///< mm, of the target lengths
  double after = 0;
};

/// What the processing did. Errors of area are area-weighted means of |A2/A3 - 1|.
struct DevelopReport {
  double errorBefore = 0;            ///< of the piece as it was, unfolded
  double errorAgainstProcessed = 0;  ///< of the processed piece, unfolded, against its own faces
  double errorAgainstOriginal = 0;   ///< of the same plane against the faces of the piece as it was
  double maxDefectBefore = 0;        ///< radians: greatest |2 pi - angle sum| of an inner vertex
  double maxDefect = 0;
  double totalDefectBefore = 0;  ///< radians: sum of |2 pi - angle sum|
  double totalDefect = 0;
  double roughnessBefore = 0;  ///< radians: root mean square of the angles between neighbour faces
  double roughness = 0;
  double maxNormalTurn = 0;         ///< radians, of a face against the piece as it was
  double maxMove = 0;               ///< mm, of a vertex
  double maxFeatureChange = 0;      ///< share of a feature's length, of the worst one
  std::optional<double> clearance;  ///< mm: least signed distance to `outsideOf`
  std::vector<FeatureChange> features;
};

/// A piece in a shape that lies flat better, and its plane.
struct DevelopedPiece {
  Piece piece;        ///< as given, with the processed mesh and the features' new target lengths
  double amount = 0;  ///< the t that was taken
  std::shared_ptr<const FlatPiece> flat;  ///< of `piece`
  DevelopReport report;
  std::vector<Finding> findings;  ///< over-limit, stopped-rough, ...
};

/// The angle sum of every inner vertex against 2 pi: 2 pi - sum, 0 on the border. Radians.
[[nodiscard]] VertexData<double> angleDefects(const Mesh& mesh);

/// Moves the inner vertices of a piece so that it lies flat with less strain; its boundary, and
/// with it every seam, stays where it is.
///
/// Damped least-norm steps towards angle sums of 2 pi at all inner vertices, along the normals, the
/// norm being that of a bent plate, in small partial targets. A surface without angle defect can
/// still be creased like paper: the processing stops before the angles between neighbour faces
/// grow rougher than a smooth surface needs, before a face turns by more than 60 degrees and before
/// an edge changes by more than 30 %. The result is M + t (M' - M) for the last shape M' it
/// reached.
///
/// @param piece a disk, possibly with holes.
/// @return the processed piece, its plane and what was done to it, or InvalidArgument for an option
///   out of range, Cancelled, and the errors of unfold().
/// @par Cost  up to maxSteps factorisations of the mesh, and one unfold() per t that is tried
/// @see C.C.L. Wang, "A least-norm approach to flattenable mesh surface processing", SMI 2008;
///   docs/developable.md tells what is different here.
Result<DevelopedPiece> develop(const Piece& piece, const DevelopOptions& options = {},
                               Progress* progress = nullptr);

/// Area-weighted mean of |A2/A3 - 1| of a plane against the faces of a piece.
[[nodiscard]] double meanAreaError(const Piece& piece, const FlatPiece& flat);

}  // namespace toile
