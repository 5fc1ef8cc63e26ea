// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/model/reference_model.h"

namespace toile::detail {

/// Keeps points that lie on the border of an open model on the border of the other.
class BorderKeeper {
 public:
  BorderKeeper(const Mesh& source, const ReferenceModel& target);

  /// @param image where the correspondence puts the point
  [[nodiscard]] SurfacePoint keep(const SurfacePoint& point, const SurfacePoint& image);
  /// curve-off-border: points whose image lies far from the border, or that has none there.
  [[nodiscard]] std::vector<Finding> findings() const;

 private:
  const Mesh& source_;
  const Mesh& target_;
  std::vector<EdgeId> borderEdges_;
  std::size_t lost_ = 0;
};

}  // namespace toile::detail
