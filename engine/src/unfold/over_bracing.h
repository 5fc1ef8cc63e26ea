// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace toile::unfolding {

/// Bars of a plane framework that brace each other more than rigidly: their lengths can be right
/// only by chance. One list per bar that is too much: the smallest set of bars, that one included,
/// of which any other could be taken out instead; ascending.
///
/// Decided by counting alone (every k joints may carry at most 2k - 3 bars), thus right for all but
/// special lengths.
/// @par Cost  linear where no set of joints with three or more bars each is left (chains, loops,
///   trees, simple crossings), else about quadratic in those.
/// @see Laman, "On Graphs and Rigidity of Plane Skeletal Structures", J. Eng. Math. 4, 1970; Jacobs
///   and Hendrickson, "An Algorithm for Two-Dimensional Rigidity Percolation: The Pebble Game",
///   J. Comput. Phys. 137, 1997.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> findOverBraced(
    std::size_t jointCount, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bars);

}  // namespace toile::unfolding
