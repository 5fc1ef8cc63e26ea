// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "toile/cut/cut.h"
#include "toile/unfold/unfold.h"

namespace toile {

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
  std::string seam;           ///< curve id
  int number = 0;             ///< the same on both mates of a seam
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
  double length = 0;     ///< mm, flat
};

/// The flat piece with everything that the cutting room needs.
struct PatternPiece {
  std::string id;
  std::string name;
  int number = 1;  ///< n of m
  int of = 1;
  int count = 1;  ///< to cut
  std::string fabric;
  std::vector<Outline> sewLines;  ///< the exact flat boundary, loop 0 is the outer one
  std::vector<Outline> cutLines;  ///< with seam allowance, loop 0 is the outer one
  std::vector<OutlineRun> runs;
  std::vector<Notch> notches;
  std::vector<InternalLine> internalLines;
  std::array<Eigen::Vector2d, 2> grain;  ///< from lower to upper end
  Eigen::Vector2d labelPosition;         ///< inside the piece
  std::vector<std::string> label;        ///< lines of text, the first is the name
  std::vector<Finding> findings;
};

/// Finishes all pieces of a pattern together, since notches come in pairs.
///
/// @param cut the pieces; @param flats per piece of `cut`, null where unfolding failed or the piece
/// is
///   left out: those give no pattern piece.
/// @return pattern pieces in the order of the pieces that have a flat.
Result<std::vector<PatternPiece>> finish(
    const Design& design, const CutResult& cut,
    const std::vector<std::shared_ptr<const FlatPiece>>& flats);

}  // namespace toile
