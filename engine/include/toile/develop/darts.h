// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
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

/// A line, or several that belong together, that would let a piece lie flat better.
struct DartProposal {
  enum class Kind {
    Dart,  ///< from the boundary to a tip inside: cloth is taken out
    Cut    ///< from boundary to boundary: where cloth is missing, a dart would overlap
  };
  Kind kind = Kind::Dart;
  SurfacePath path;  ///< on the piece's mesh, a dart's from its mouth to its tip
  /// Further darts: the mirror image on a symmetric piece, or those spread evenly round the apex.
  std::vector<SurfacePath> companions;
  bool isSymmetric = false;  ///< all darts together are their own mirror image, as the piece is
  VertexId apex;             ///< what it aims at
  double length = 0;         ///< mm: of seam that is added, by all darts together
  double intake = 0;         ///< mm: how wide the widest mouth opens in the plane; 0 for a cut
  double errorBefore = 0;    ///< mean area error
  double errorAfter = 0;     ///< measured by unfolding; of a cut over both parts
  [[nodiscard]] std::size_t dartCount() const { return 1 + companions.size(); }
};

struct DartOptions {
  UnfoldOptions unfold{};
  std::size_t maxProposals = 6;  ///< 1..16: that are unfolded
  /// The tip stops before the apex by this, or by an eighth of the dart if that is less.
  Length tipDistance = Length::mm(15);
  /// The mean area error that is good enough: proposals that reach it come first, those with the
  /// fewest darts before the others, and several darts spread evenly round a dome are tried too.
  std::optional<Ratio> limit{};
};

/// Darts for a piece that lies flat badly or on itself, and after them cuts; those that leave the
/// least error first, or with a limit those that gain the most per dart. They start at the
/// boundary, not near its corners, cross no line of the piece and run straight on the surface to
/// where the curvature weighs most. On a piece that is its own mirror image they lie on its middle
/// or come in pairs.
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

/// The patch with darts along the paths: faces are re-cut so that they run along edges. Vertices
/// stay, new ones come after them; a face's parts come in its place.
/// @param paths on the mesh of `piece`, which is makePiece() of the patch; each begins at a vertex
///   of the boundary.
/// @param ids of the darts, one per path.
Result<Patch> addDarts(const Patch& patch, const Piece& piece, std::span<const SurfacePath> paths,
                       std::span<const std::string> ids);

struct AutoDart {
  Patch patch;
  Piece piece;
  std::shared_ptr<const FlatPiece> flat;
  std::vector<DartProposal> darts;  ///< that were put in, in their order: "autodart-1", ...
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
