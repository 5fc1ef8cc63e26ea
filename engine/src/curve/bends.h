// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace toile::detail {

/// Changes of side in a row of turns (radians): bends are runs of one sign; those that turn by less
/// than `least` are joined to what is around them, the smallest first.
[[nodiscard]] int countInflections(const std::vector<double>& turns, bool closed, double least);

}  // namespace toile::detail
