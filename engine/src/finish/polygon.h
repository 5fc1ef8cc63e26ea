// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "toile/finish/pattern_piece.h"

namespace toile {

/// A closed polygon or an open polyline in the plane, mm; a polygon does not repeat its first
/// point.
using Points2 = std::vector<Eigen::Vector2d>;

[[nodiscard]] inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}
[[nodiscard]] Points2 positions(const Outline& outline);
[[nodiscard]] std::vector<Points2> positions(const std::vector<Outline>& outlines);

/// Positive for counter-clockwise polygons.
[[nodiscard]] double signedArea(std::span<const Eigen::Vector2d> polygon);
/// Angle by which the way a-b-c turns at b, -pi..pi, positive to the left.
[[nodiscard]] double turnAngle(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                               const Eigen::Vector2d& c);
/// Even-odd rule over all loops: inside the outer loop and outside the holes.
[[nodiscard]] bool isInside(const std::vector<Points2>& loops, const Eigen::Vector2d& p);

/// Leaves out vertices of a closed polygon that lie within `tolerance` of the chord that replaces
/// them; those with keep[i] != 0 stay. @return indices of the vertices that stay, ascending.
[[nodiscard]] std::vector<std::size_t> simplifiedIndices(std::span<const Eigen::Vector2d> polygon,
                                                         std::span<const char> keep,
                                                         double tolerance);

struct Box2 {
  Eigen::Vector2d min{0, 0};
  Eigen::Vector2d max{0, 0};
  [[nodiscard]] Eigen::Vector2d size() const { return max - min; }
};
/// Of no points: a box at the origin.
[[nodiscard]] Box2 boxOf(std::span<const Eigen::Vector2d> points);

/// Whether a segment has points in a box.
[[nodiscard]] bool crosses(const Box2& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Finds the nearest edge of closed polygons; a uniform grid over their edges.
class EdgeGrid {
 public:
  explicit EdgeGrid(const std::vector<Points2>& loops);
  struct Nearest {
    double distance = 0;
    std::size_t edge = 0;  ///< counted over all loops: edge i begins at point i
    Eigen::Vector2d point{0, 0};
  };
  /// Precondition: the polygons have at least one edge. Ties go to the smaller edge.
  [[nodiscard]] Nearest nearest(const Eigen::Vector2d& p) const;

 private:
  [[nodiscard]] std::int64_t column(double x) const;
  [[nodiscard]] std::int64_t row(double y) const;

  std::vector<std::array<Eigen::Vector2d, 2>> edges_;
  std::vector<std::vector<std::uint32_t>> cells_;
  Box2 box_;
  double cellSize_ = 1;
  std::int64_t columns_ = 1, rows_ = 1;
};

/// The point inside the polygons that lies farthest from their lines (to 0.5 mm), and how far.
struct InmostPoint {
  Eigen::Vector2d position{0, 0};
  double clearance = 0;  ///< mm
};
/// Quadtree search for the centre of the greatest inscribed circle. Precondition: an outer loop
/// with at least three points.
[[nodiscard]] InmostPoint inmostPoint(const std::vector<Points2>& loops);

}  // namespace toile
