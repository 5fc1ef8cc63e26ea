// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "toile/cut/cut.h"
#include "toile/model/reference_model.h"

namespace toile {

struct EdgeOfWire {
  std::size_t wire = 0, edge = 0;
  bool isBackward = true;  ///< walked from its end
};

/// Which edges of one piece's wires are the mirror images of which of another's (or of its own) by
/// the model's pairing of vertices, which the model must have.
class WireMatch {
 public:
  WireMatch(const ReferenceModel& model, const Piece& original, const Piece& twin);

  /// @return per wire and edge of the twin that of the original; nothing unless all have one.
  [[nodiscard]] std::optional<std::vector<std::vector<EdgeOfWire>>> find() const;
  /// Of the original's vertices, on the model.
  [[nodiscard]] const std::vector<SurfacePoint>& images() const { return images_; }

 private:
  /// The vertex, edge or face that a surface point lies on.
  using Carrier = std::pair<std::size_t, std::uint32_t>;
  static Carrier carrierOf(const SurfacePoint& point);
  [[nodiscard]] std::optional<EdgeOfWire> imageOf(VertexId from, VertexId to) const;
  [[nodiscard]] bool isAt(const SurfacePoint& point, VertexId v) const;

  const ReferenceModel& model_;
  const Piece& original_;
  const Piece& twin_;
  std::multimap<std::pair<Carrier, Carrier>, EdgeOfWire> byEnds_;
  std::vector<SurfacePoint> images_;
};

/// Copies the targets of the cut's edges into the wires of the pieces.
void copyTargets(const RefinedMesh& refined, std::vector<Piece>& pieces);

}  // namespace toile
