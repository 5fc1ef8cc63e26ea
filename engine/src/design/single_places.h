// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

#include "toile/design/design.h"

namespace toile::detail {

/// Calls `function` with every place of one kind that a place is made of: itself, or its ends.
template <class Kind, class Function>
void forEachOfKind(const Place& place, Function function) {
  if (const auto* itself = std::get_if<Kind>(&place)) function(*itself);
  if (const auto* between = std::get_if<BetweenPlaces>(&place)) {
    for (const SinglePlace& end : between->ends) {
      if (const auto* single = std::get_if<Kind>(&end)) function(*single);
    }
  }
}

}  // namespace toile::detail
