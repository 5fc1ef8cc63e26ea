// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/core/units.h"

namespace toile {

// What the finish of a design may say. More is a slip of the unit ("10m" for "10mm"), which would
// otherwise become a cut line that no cutter can use.

/// The widest of real work: hems of curtains, and what is tucked in behind the seat of a sofa.
inline constexpr Length kMostAllowance = Length::mm(300);
/// Of a notch's depth and width; a depth may be 0, which is a notch that is only drawn.
inline constexpr Length kMostNotchSize = Length::mm(50);
inline constexpr Length kLeastNotchWidth = Length::mm(0.5);
/// Nearer together, a sewer cannot tell which notch meets which.
inline constexpr Length kLeastNotchSpacing = Length::mm(20);
inline constexpr Length kMostNotchSpacing = Length::mm(10000);

}  // namespace toile
