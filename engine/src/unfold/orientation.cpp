// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace toile::unfolding {

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;
  return static_cast<int>(
      CGAL::orientation(Point(a.x(), a.y()), Point(b.x(), b.y()), Point(c.x(), c.y())));
}

}  // namespace toile::unfolding
