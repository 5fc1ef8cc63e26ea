// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "curve/local_closest.h"
#include "edit/displacement.h"
#include "edit/work_curve.h"
#include "toile/mesh/surface_index.h"

namespace toile::detail {

/// A data point of a stretch that holds or moves the curve.
struct Knot {
  std::size_t data = 0;            ///< index in the curve
  std::optional<SurfacePoint> to;  ///< absent: stays
};

/// Changes the stretch of a curve between two of its data points.
///
/// Knots (the first and the last are the ends of the stretch) move to their new places; what lies
/// between them follows by a smooth displacement, is put on the surface by closest point, on the
/// limb where the knots are, and linked. Where the stretch grows longer data points are added, as
/// dense as before. Everything else stays, bit for bit: data points and links outside of the
/// stretch, and those that the displacement does not reach.
class Reshaper {
 public:
  Reshaper(const SurfaceIndex& index, GeodesicLinker& linker)
      : index_(index), linker_(linker), local_(index.mesh()) {}

  /// @param knots ascending; of a closed curve none may wrap (rotate() first).
  /// @return the changed curve, and for every data point of the old one its place in it.
  struct Reshaped {
    WorkCurve curve;
    std::vector<std::size_t> newIndex;  ///< of old data points
  };
  Result<Reshaped> reshape(const WorkCurve& old, const std::vector<Knot>& knots, StretchEnd first,
                           StretchEnd last);

 private:
  const SurfaceIndex& index_;
  GeodesicLinker& linker_;
  LocalClosest local_;
};

}  // namespace toile::detail
