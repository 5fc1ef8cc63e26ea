// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "edit/reshape.h"
#include "edit/sketch.h"

namespace toile::detail {

/// Which curves of a design have a data point: how lines share their crossings.
class DataPoints {
 public:
  explicit DataPoints(const Design& design);
  /// Indices of the curves that have exactly this data point, ascending.
  [[nodiscard]] std::vector<std::size_t> curvesAt(const ModelPoint& point) const;

 private:
  const Design& design_;
  std::unordered_multimap<std::uint64_t, std::pair<std::size_t, std::size_t>> places_;
};

/// A data point of a curve that an edit has moved.
struct MovedNode {
  SurfacePoint from;
  SurfacePoint to;
  bool isDragged = false;  ///< taken by hand, not carried along
  std::string rail{};      ///< a curve that it slides along, which stays where it is
};

/// Keeps crossings shared after curve `id` was changed: curves that end at a moved point end at its
/// new place; one that passes through a point taken by hand goes with it; with all
/// of them every place where they meet `curve` now is a data point of both. Only curves with data
/// points are looked at: others follow by themselves.
Result<void> followNodes(Sketch& sketch, const std::string& id, WorkCurve& curve,
                         const std::vector<MovedNode>& moved);

/// The stretch of a curve around a data point, up to the next control points or shared points
/// (`isHeld`) on both sides, as knots; the point itself goes to `to`.
std::vector<Knot> knotsAround(const WorkCurve& curve, std::size_t data, const SurfacePoint& to,
                              const std::vector<bool>& isHeld);

}  // namespace toile::detail
