// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "finish/allowance.h"
#include "finish/seam_net.h"

namespace toile {

/// Ends of the allowances of two mates may differ by so much before both are made alike.
inline constexpr double kCornerMatchMm = 0.5;

/// The corner at the begin of every run, per piece, from the style that each side asks for.
///
/// A mirrored side (a hem) rules its corners, then a square one, then a truncated one. Mitres at
/// the end of a seam are made alike on both mates, so that the ends of their allowances lie on each
/// other when sewn: the one that reaches farther is cut off square to the seam where the other
/// ends.
[[nodiscard]] std::vector<std::vector<Corner>> planCorners(
    const SeamNet& net, const std::vector<std::vector<CornerStyle>>& styles);

}  // namespace toile
