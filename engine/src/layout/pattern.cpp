// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/layout/pattern.h"

namespace toile {

bool Pattern::isComplete() const {
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    if (!cut.pieces[i].include) continue;
    if (i >= flats.size() || !flats[i] || !flats[i]->check.passes()) return false;
    if (i < failures.size() && failures[i]) return false;
  }
  return true;
}

}  // namespace toile
