// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "toile/mesh/surface_index.h"

namespace toile {

/// For two models A and B, the map from a surface point of one to a surface point of the other.
///
/// It goes through two shapes of one connectivity, one close to A, one close to B: nearest point of
/// the first, same face and weights on the second, nearest point of B. Where A or B is that shape
/// itself its step is left out, so that between bodies of one connectivity there and back is the
/// identity, bit for bit.
class Correspondence {
 public:
  /// Between two shapes of one connectivity. @return ModelMismatch otherwise.
  static Result<Correspondence> onOneConnectivity(std::shared_ptr<const SurfaceIndex> a,
                                                  std::shared_ptr<const SurfaceIndex> b);
  /// Between A and any surface B, of which `fitted` is the shape on A's connectivity.
  /// @return ModelMismatch when `a` and `fitted` differ in connectivity.
  static Result<Correspondence> throughFit(std::shared_ptr<const SurfaceIndex> a,
                                           std::shared_ptr<const SurfaceIndex> fitted,
                                           std::shared_ptr<const SurfaceIndex> b);

  [[nodiscard]] SurfacePoint toB(const SurfacePoint& onA) const;
  [[nodiscard]] SurfacePoint toA(const SurfacePoint& onB) const;

 private:
  Correspondence() = default;
  std::shared_ptr<const SurfaceIndex> fitted_;  ///< the shape of A's connectivity near B, or B
  std::shared_ptr<const SurfaceIndex> b_;       ///< null where `fitted_` is B
};

}  // namespace toile
