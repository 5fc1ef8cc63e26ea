// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile {

/// The number of a seam as people read it, so that it is not taken for a notch: A, B, ... Z, AA.
[[nodiscard]] std::string seamLetters(int seam);

/// One side of a seam: the runs of one seam number on one side, in order along the outline.
struct SewEdge {
  std::string code;  ///< piece number and letters of the seam, "3C"; "3Ca", "3Cb" in one piece
  std::uint32_t piece = 0;          ///< index of the pattern piece
  std::vector<std::uint32_t> runs;  ///< of its `runs`
  std::string curve;                ///< id
  int seam = 0;
  std::uint32_t mate = 0;  ///< index of the edge sewn on; its own where that one is not there
  double body = 0;         ///< mm, on the model
  double target = 0;       ///< mm
  double length = 0;       ///< mm, on the pattern
  bool isDart = false;
  bool isRing = false;  ///< begins where it ends
};

/// One seam to sew.
struct SewStep {
  std::uint32_t edgeA = 0, edgeB = 0;  ///< of SewingPlan::edges; A runs along its piece's outline
  enum class Kind {
    Dart,  ///< within one piece, first
    Flat,  ///< joins two parts, or neighbouring edges of one, that lie flat
    Tube,  ///< closes what is joined already to a tube, or goes on along a tube
    Round  ///< a ring into a ring: a sleeve into its armhole
  } kind = Kind::Flat;
  double length = 0;   ///< mm, the longer side
  double minutes = 0;  ///< estimated: see minutesOf()
};

/// What has to be sewn, and in which order.
struct SewingPlan {
  std::vector<SewEdge> edges;  ///< in the order of pieces and their outlines
  std::vector<SewStep> steps;  ///< in the order of sewing
  double totalLength = 0;      ///< mm, of all steps
  double minutes = 0;
};

/// Works the order of sewing out from the seams: darts, then what can be sewn flat, then what
/// closes tubes, rings last. A seam that ends in the middle of another one is sewn before it; among
/// those that are free the longer first.
SewingPlan planSewing(const Pattern& pattern);

/// "3C" and, where it says more, "3C-5C": the codes of an edge and of the one that it meets; empty
/// for a run that is not sewn.
[[nodiscard]] std::string edgeCodes(const Pattern& pattern, const PatternPiece& piece,
                                    const OutlineRun& run);

/// How a length is held.
enum class LengthRule { Keep, Range, Free };
[[nodiscard]] std::string_view toString(LengthRule rule);  ///< "keep", "range", "free"

/// A line of the length contract: what a curve measures in a piece.
struct LengthLine {
  std::string piece, curve, kind;  ///< ids, and the kind of its wires
  std::string name;                ///< of the curve, for people
  std::string edge;                ///< code of the edge; empty for inner lines and borders
  LengthRule rule = LengthRule::Keep;
  double body = 0;     ///< mm, on the model
  double target = 0;   ///< mm, what ease, thickness and processing make of it
  double pattern = 0;  ///< mm, along the sew line
  std::string matePiece;
  double mate = 0;  ///< mm, along the mate's sew line; 0 without mate
  /// mm: pattern - mate where there is one, else pattern - target.
  double difference = 0;
};

/// Every line of every pattern piece. Seams and features are kept; elastic lines have a range; the
/// lengths of marks are free.
std::vector<LengthLine> lengthContract(const Pattern& pattern);

/// Of all that the lengths follow from: the design as it is written to a file, and the model's
/// vertices and faces.
ContentHash inputsHash(const Document& document);

}  // namespace toile
