// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/warp/warp.h"
#include "warp/settle.h"

namespace toile::detail {

/// A girth of the body and the line of the product over it, sampled in the same order.
struct GirthLine {
  std::string name;
  std::vector<SurfacePoint> onA, onB;
  std::vector<EasePoint> onProduct;  ///< with the distance prescribed
  bool closed = true;
};

struct BeforeAndAfter {
  const ReferenceModel &a, &b, &productBefore, &productAfter;
  const std::vector<GirthLine>& girths;
  const std::vector<double>& easeBefore;  ///< per vertex, mm
  const std::vector<double>& easeWeight;
};

/// Measures a warped product by its places alone, and says what stands against it.
[[nodiscard]] WarpReport judgeWarp(const BeforeAndAfter& warp);

}  // namespace toile::detail
