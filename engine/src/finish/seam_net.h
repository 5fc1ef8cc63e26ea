// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "finish/outline.h"

namespace toile {

/// A piece on its way through finish().
struct PieceInWork {
  std::uint32_t index = 0;  ///< in CutResult::pieces
  const Piece* piece = nullptr;
  const FlatPiece* flat = nullptr;
  SewOutline sew;
};

/// A run of a piece in work: indices into the list of pieces and into its `sew.runs`.
struct RunId {
  std::uint32_t piece = 0;
  std::uint32_t run = 0;
  friend auto operator<=>(const RunId&, const RunId&) = default;
};

/// Which runs are sewn together, and which of their ends meet in one point of the sewn article.
class SeamNet {
 public:
  SeamNet(const std::vector<PieceInWork>& pieces, const CutResult& cut);

  [[nodiscard]] const OutlineRun& at(RunId id) const;
  [[nodiscard]] std::optional<RunId> mate(RunId id) const;
  [[nodiscard]] RunId next(RunId id) const;      ///< the following run of its loop
  [[nodiscard]] RunId previous(RunId id) const;  ///< the run before it in its loop
  /// The outline turns where the run begins.
  [[nodiscard]] bool beginsAtCorner(RunId id) const;
  /// The point of the sewn article where the run begins: equal for all runs that begin there.
  [[nodiscard]] std::size_t node(RunId id) const;
  /// From 1 in the order of pieces and runs; the runs of a curve between the same two pieces have
  /// one number as long as no corner parts them. 0 = not sewn.
  [[nodiscard]] int seam(RunId id) const;
  /// The runs with that run's number on its side, in order along the outline.
  [[nodiscard]] std::vector<RunId> chain(RunId id) const;
  [[nodiscard]] const std::vector<PieceInWork>& pieces() const { return pieces_; }
  /// All runs in order.
  [[nodiscard]] const std::vector<RunId>& runs() const { return runs_; }

 private:
  [[nodiscard]] std::size_t flat(RunId id) const { return offset_[id.piece] + id.run; }
  [[nodiscard]] bool continues(RunId id) const;

  const std::vector<PieceInWork>& pieces_;
  std::vector<std::size_t> offset_;  ///< of each piece's runs in the tables below
  std::vector<RunId> runs_;
  std::vector<std::optional<RunId>> mate_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::size_t> node_;
  std::vector<int> seam_;
};

}  // namespace toile
