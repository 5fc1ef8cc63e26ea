// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "toile/cut/cut.h"
#include "toile/unfold/unfold.h"

namespace toile {

/// By how much smoothing may change the length of a run, mm.
inline constexpr double kSmoothingMm = 0.01;

/// A vertex of an outline.
struct OutlinePoint {
  Eigen::Vector2d position;  ///< mm
  bool corner = false;       ///< the line turns here; otherwise it passes smoothly
};
/// Closed, not repeated at the end. Outer loops counter-clockwise, holes clockwise.
using Outline = std::vector<OutlinePoint>;

struct Notch {
  Eigen::Vector2d
      position;  ///< mm, a vertex of the cut line (of the sew line where there is no allowance)
  Eigen::Vector2d onSewLine;  ///< mm
  Eigen::Vector2d direction;  ///< unit, into the piece
  double depth = 4;           ///< mm
  NotchKind kind = NotchKind::Slit;
  double width = 0;  ///< mm, at the edge; 0 for a slit
  std::string seam;  ///< curve id of the run it stands on
  /// The same on every piece that is sewn together there; 0 where the neighbours' own seam ends, so
  /// that they have a corner there and no notch.
  int number = 0;
};

/// A line drawn on the piece, not cut.
struct InternalLine {
  CurveKind kind = CurveKind::Feature;
  std::string curve;  ///< id
  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< mm
  bool closed = false;
};

/// A run of the sew line that belongs to one curve, for edge names and the report.
struct OutlineRun {
  std::string curve;
  WireKind kind = WireKind::Seam;
  std::uint32_t wire = 0;  ///< index in Piece::wires
  std::size_t loop = 0;    ///< of sewLines
  std::size_t first = 0;   ///< index of its first point in that loop
  std::size_t edgeCount = 0;
  double allowance = 0;  ///< mm
  /// A dart that is folded, not cut out: the cut line passes its mouth with a cap that lies flush
  /// when the dart is folded.
  bool folded = false;
  double length = 0;  ///< mm, flat
  /// Number of the seam, the same on both sides, counted from 1 over the whole pattern: what the
  /// pieces show beside their edges. Runs that feature lines part share it. 0 = not sewn.
  int seam = 0;
  std::string mate;  ///< id of the piece sewn on here; empty = none
  /// Where circular arcs may replace the chords: points counted from the run's first one, from 0 to
  /// edgeCount, the same on the mate. Each arc through two of them has the length of its chords.
  std::vector<std::size_t> arcEnds{};
};

/// The flat piece with everything that the cutting room needs.
struct PatternPiece {
  std::string id;
  std::string name;
  int number = 1;  ///< n of m
  int of = 1;
  int count = 1;  ///< to cut
  std::string fabric;
  /// The flat boundary with the points that its lengths do not need left out, loop 0 is the outer
  /// one; each run is at most kSmoothingMm shorter, and points are left out on both mates alike.
  std::vector<Outline> sewLines;
  std::vector<Outline> cutLines;  ///< with seam allowance, loop 0 is the outer one
  std::vector<OutlineRun> runs;
  std::vector<Notch> notches;
  std::vector<Eigen::Vector2d> drillHoles;  ///< mm: where a dart is stitched to
  std::vector<InternalLine> internalLines;
  std::array<Eigen::Vector2d, 2> grain;  ///< from lower to upper end
  bool oneWay = false;                   ///< the cloth has a nap: the upper end points up
  /// The edge that lies on folded cloth, where the piece is half of what is cut.
  std::optional<std::array<Eigen::Vector2d, 2>> fold;
  Eigen::Vector2d labelPosition;   ///< inside the piece
  std::vector<std::string> label;  ///< lines of text, the first is the name
  std::vector<Finding> findings;
};

/// Finishes all pieces of a pattern together, since notches come in pairs.
///
/// The sew line is the flat boundary itself. The cut line lies outside of it by the allowance of
/// each run (of that side of its curve, else of the options), corners mitred. Notches stand where
/// feature lines and other seams meet a seam and about every `notchSpacing` along it, at equal
/// sewn lengths on both sides, never at corners except beside a dart's mouth; two side by side on
/// seams of the back.
///
/// @param document the design and the model it is made for.
/// @param curves the design's curves on that model: they say which side of a seam is the left one,
///   and where marks lie.
/// @param cut the pieces.
/// @param flats per piece of `cut`, null where unfolding failed or the piece is left out: those
/// give no pattern piece.
/// @param known per piece of `cut` what it was finished to before, if that is good enough (a
///   preview, of what is not touched): taken as it is. Null or absent: finish it.
/// @return pattern pieces in the order of the pieces that have a flat, or InvalidArgument where a
///   piece's boundary wires do not form closed loops or a flat piece does not fit its piece.
Result<std::vector<PatternPiece>> finish(const Document& document,
                                         const std::vector<PlacedCurve>& curves,
                                         const CutResult& cut,
                                         const std::vector<std::shared_ptr<const FlatPiece>>& flats,
                                         const std::vector<const PatternPiece*>& known = {});

/// Makes a symmetric piece (to 0.05 mm, about a line across its up, without holes) the half that
/// lies on the wearer's left, with its edge on the fold; the seams of the other half go.
/// @param piece the piece that it was made of, and how that lies flat
/// @return whether it was symmetric; otherwise nothing changes
bool foldInHalf(PatternPiece& pattern, const Piece& piece, const FlatPiece& flat);

}  // namespace toile
