// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/history.h"

#include <utility>

namespace toile::studio {

void History::push(Step step) {
  steps_.resize(at_ + 1);
  steps_.push_back(std::move(step));
  at_ = steps_.size() - 1;
}

}  // namespace toile::studio
