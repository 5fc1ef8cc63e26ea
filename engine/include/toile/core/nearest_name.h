// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace toile {

/// The candidate that takes the fewest typing slips to become the name (a letter added, left out,
/// changed, or two neighbours swapped); the first of several. Empty when none is near: more slips
/// than a third of the name's length plus one.
[[nodiscard]] std::string nearestName(std::string_view name,
                                      std::span<const std::string> candidates);

/// For messages: "; did you mean \"waist_girth\"?" or, when none is near, the first few of what
/// there is: "; there are: a, b, c and 12 more". Empty without candidates.
[[nodiscard]] std::string suggestion(std::string_view name,
                                     std::span<const std::string> candidates);

}  // namespace toile
