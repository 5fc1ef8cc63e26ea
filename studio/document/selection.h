// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace toile::studio {

/// What is selected, the same in both panes. One thing at a time.
struct Selection {
  enum class Kind { None, Line, Piece };
  Kind kind = Kind::None;
  std::string id;                     ///< of the curve or the piece
  std::optional<std::size_t> handle;  ///< of a line: one of its points
  /// In the pattern a line is a run of a piece: the piece that was pointed at.
  std::string onPiece;

  static Selection line(std::string id) { return {Kind::Line, std::move(id), {}, {}}; }
  static Selection piece(std::string id) { return {Kind::Piece, std::move(id), {}, {}}; }
  [[nodiscard]] bool isLine(const std::string& curve) const {
    return kind == Kind::Line && id == curve;
  }
  [[nodiscard]] bool isPiece(const std::string& piece) const {
    return kind == Kind::Piece && id == piece;
  }
  friend bool operator==(const Selection&, const Selection&) = default;
};

}  // namespace toile::studio
