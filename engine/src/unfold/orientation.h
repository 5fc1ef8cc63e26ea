// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace toile::unfolding {

/// +1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on a line; exact.
[[nodiscard]] int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                              const Eigen::Vector2d& c);

}  // namespace toile::unfolding
