// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile::studio {

/// Which piece of a pattern a place of the body belongs to.
class PieceFinder {
 public:
  explicit PieceFinder(std::shared_ptr<const Pattern> pattern);

  /// @return index in pattern.cut.pieces
  [[nodiscard]] std::optional<std::size_t> pieceAt(const SurfacePoint& point) const;

 private:
  struct Part {
    std::size_t piece;
    FaceId face;  ///< of the piece
  };
  std::shared_ptr<const Pattern> pattern_;
  std::unordered_map<std::uint32_t, std::vector<Part>> partsOfFace_;  ///< by face of the model
};

}  // namespace toile::studio
