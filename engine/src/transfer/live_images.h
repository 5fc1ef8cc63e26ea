// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "edit/sketch.h"

namespace toile::detail {

/// Makes curves that are live mirror images in `own` ones again. Where the model pairs its vertices
/// they get their shape from their originals; what met the image follows it there. Without a
/// pairing they keep their own data points beside `mirrorOf`.
/// @param originalOf per curve of the design, of a live image
Result<void> reviveImages(Sketch& sketch, const Design& own,
                          const std::vector<std::optional<std::size_t>>& originalOf);

}  // namespace toile::detail
