// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "toile/pipeline.h"

namespace toile {

enum class Quality {
  Preview,  ///< for the eye while something is dragged
  Full      ///< what makePattern() gives, byte for byte
};

/// How far one piece of a live pattern is.
struct LivePiece {
  enum class State {
    Full,     ///< the exact answer
    Preview,  ///< near it: lengths to about a thousandth
    Failed,   ///< `Pattern::failures` says why; there is no plane
    LeftOut   ///< not included in the design
  };
  State state = State::LeftOut;
  /// The flat piece is the one of the answer before, the same object: nothing of it changed.
  bool isReused = false;
};

struct LiveAnswer {
  /// A preview's is never to be cut from: see `pieces`. Its layout leaves known pieces where the
  /// last answer had them.
  Pattern pattern;
  std::vector<LivePiece> pieces;  ///< parallel to `pattern.cut.pieces`
  /// Every piece is as makePattern() makes it.
  [[nodiscard]] bool isFull() const;
};

/// The pattern of a document that is being edited: after each change only the pieces that it
/// touched are solved.
///
///     LivePattern live;
///     live.update(opened, Quality::Full);
///     live.update(dragged, Quality::Preview);   // for each move of the hand
///     live.update(dropped, Quality::Full);
///
/// A piece is touched when its content changed: positions, faces, wires, target lengths. Pieces
/// that were solved before, in this or an earlier answer (undo), are taken over as the same
/// objects. For use off the thread that draws: calls block; one call at a time. A call that is
/// stopped or fails leaves everything as it was.
class LivePattern {
 public:
  explicit LivePattern(const MakeOptions& options = {});
  ~LivePattern();
  LivePattern(const LivePattern&) = delete;
  LivePattern& operator=(const LivePattern&) = delete;

  /// The pattern of the document.
  ///
  /// Full: what makePattern() gives for this document and these options, whatever came before.
  /// Preview: touched pieces by one step of the solver, from the last preview of the piece where
  /// that fits (UnfoldPreview); without darts of `autoDart` and without developable processing of
  /// pieces that are touched.
  ///
  /// @param progress may be null; polled, and true from isCancelled() ends the call.
  /// @return what makePattern() returns; Cancelled.
  /// @par Cost  cutting, finishing and arranging all pieces, solving the touched ones; for a
  ///   wetsuit on 25k triangles see bench/live_bench.cpp
  Result<LiveAnswer> update(const Document& document, Quality quality,
                            Progress* progress = nullptr);

  /// Pieces solved, previewed and taken over so far; for tests and for curious people.
  struct Counts {
    std::size_t solved = 0, previewed = 0, reused = 0;
  };
  [[nodiscard]] Counts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile
