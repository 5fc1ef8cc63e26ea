// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace toile::detail {

/// What an end of a stretch keeps when the stretch is displaced.
enum class StretchEnd {
  Tangent,  ///< place and direction: the curve goes on beyond
  Place     ///< the place: the curve's own end
};

/// A smooth displacement along a stretch, from that of a few places: the cubic spline through them,
/// or, where their spans are uneven by more than three times, the cubic that does not overshoot.
class Displacement {
 public:
  /// @param arcs ascending, at least two; the ends of the stretch are the first and the last
  Displacement(std::vector<double> arcs, std::vector<Eigen::Vector3d> values, StretchEnd first,
               StretchEnd last);
  [[nodiscard]] Eigen::Vector3d at(double arc) const;

 private:
  std::vector<double> arcs_;
  std::vector<Eigen::Vector3d> values_, slopes_;
};

}  // namespace toile::detail
