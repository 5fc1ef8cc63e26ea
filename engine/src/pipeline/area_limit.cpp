// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "toile/pipeline.h"

namespace toile {

std::optional<Ratio> AreaLimit::of(const Design& design, const std::string& pieceId) const {
  if (ofAll) return ofAll;
  const StrainLimits limits = strainLimits(design, pieceId);
  if (!limits.along && !limits.across) return std::nullopt;
  return Ratio::of(std::min(limits.along.value_or(limits.across.value_or(0)),
                            limits.across.value_or(limits.along.value_or(0))));
}

}  // namespace toile
