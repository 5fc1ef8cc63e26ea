// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/core/units.h"
#include "toile/mesh/surface_point.h"
#include "toile/unfold/unfold.h"

namespace toile {

/// What exact lengths of the wires cost a piece, before anything is solved.
struct ForcedError {
  /// No plane with these lengths has a smaller mean area error: a closed line of length L encloses
  /// at most L^2 / 4 pi. Per region between wires, weighted by area.
  double bound = 0;
  /// Mean area error of the conformal plane with these lengths: what to expect.
  double estimate = 0;
  double totalCurvature = 0;  ///< radians: sum of the angle defects of all inner vertices
  /// Where the curvature weighs most: it wants a dart (bulge > 0) or a gusset or cut (< 0).
  VertexId apex;
  double bulge = 0;  ///< logarithm of the scale of lengths that is lost there
};

/// @return NotADisk for a piece without boundary
/// @par Cost  one sparse factorisation
[[nodiscard]] Result<ForcedError> measureForcedError(const Piece& piece);

/// A line that would let a piece lie flat better.
struct DartProposal {
  enum class Kind {
    Dart,  ///< from the boundary to a tip inside: cloth is taken out
    Cut    ///< from boundary to boundary: where cloth is missing, a dart would overlap
  };
  Kind kind = Kind::Dart;
  SurfacePath path;        ///< on the piece's mesh, a dart's from its mouth to its tip
  VertexId apex;           ///< what it aims at
  double length = 0;       ///< mm: of seam that is added
  double intake = 0;       ///< mm: how wide the mouth opens in the plane; 0 for a cut
  double errorBefore = 0;  ///< mean area error
  double errorAfter = 0;   ///< measured by unfolding; of a cut over both parts
};

struct DartOptions {
  UnfoldOptions unfold{};
  std::size_t maxProposals = 6;  ///< 1..16: that are unfolded
  /// The tip stops before the apex by this, or by an eighth of the dart if that is less.
  Length tipDistance = Length::mm(15);
};

/// Darts for a piece that lies flat badly or on itself, those that leave the least error first, and
/// after them cuts. They start at the boundary, not near its corners, cross no line of the piece
/// and run straight on the surface to where the curvature weighs most.
///
/// @param flat of this piece.
/// @return none if no line helps; errors of reading the piece only
/// @par Cost  maxProposals times unfold()
/// @see McCartney, Hinds, Seow, "The flattening of triangulated surfaces incorporating darts and
///   gussets", CAD 31, 1999, for the idea; the measure that places them is docs/darts.md.
Result<std::vector<DartProposal>> adviseDarts(const Piece& piece, const FlatPiece& flat,
                                              const DartOptions& options = {},
                                              Progress* progress = nullptr);

/// A surface patch with its lines, as a mesh file holds it.
struct Patch {
  Mesh mesh;
  std::vector<PolygonSoup::Chain> chains;
  std::map<std::string, double> targets;
  FaceData<FaceId> sourceFace;  ///< of the mesh that it was read from; empty = its own
};

/// The patch with a dart along the path: faces are re-cut so that it runs along edges. Vertices
/// stay, new ones come after them; a face's parts come in its place.
/// @param path on the mesh of `piece`, which is makePiece() of the patch.
Result<Patch> addDart(const Patch& patch, const Piece& piece, const SurfacePath& path,
                      const std::string& id);

struct AutoDart {
  Patch patch;
  Piece piece;
  std::shared_ptr<const FlatPiece> flat;
  std::vector<DartProposal> darts;  ///< that were put in, in their order
  ForcedError forced;               ///< of the patch as it was
  double errorBefore = 0;
  std::vector<Finding> findings;  ///< each dart; why the limit is not met
};

/// Puts in the best dart again and again until the mean area error is at most `limit` and nothing
/// overlaps, no dart helps by a tenth or `maxDarts` are in.
Result<AutoDart> autoDart(Patch patch, const std::string& name, Ratio limit,
                          const DartOptions& options = {}, int maxDarts = 8,
                          Progress* progress = nullptr);

/// In one line for people: "dart, 84 mm long, 12.3 mm wide at its mouth".
[[nodiscard]] std::string describe(const DartProposal& proposal);

}  // namespace toile
