// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "toile/layout/layout.h"

namespace toile {

Eigen::Vector2d Placement::apply(const Eigen::Vector2d& p) const {
  return applyToDirection(p) + offset;
}

Eigen::Vector2d Placement::applyToDirection(const Eigen::Vector2d& d) const {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * d.x() - s * d.y(), s * d.x() + c * d.y()};
}

}  // namespace toile
