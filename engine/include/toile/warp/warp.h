// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/fit/correspondence.h"
#include "toile/model/reference_model.h"

namespace toile {

/// A line round the body at which the product's distance is prescribed.
struct WarpGirth {
  std::string name;
  SurfacePath path;            ///< on the body that the product stands around
  std::optional<Length> ease;  ///< distance to the other body; without it what it was
};

struct WarpOptions {
  std::vector<WarpGirth> girths{};
  /// Parts of the product that are only moved and turned, each by itself: their vertices. A vertex
  /// belongs to one part at most.
  std::vector<std::vector<VertexId>> rigid{};
  /// The product comes no nearer than this to the body, except where it was nearer before.
  Length leastEase = Length::mm(0);
};

/// Distances to the body are signed: positive outside of it.
struct WarpedGirth {
  std::string name;
  double bodyBefore = 0, bodyAfter = 0;        ///< length on the bodies, mm
  double productBefore = 0, productAfter = 0;  ///< length of the product over it, mm
  double easeBefore = 0, easeAfter = 0;        ///< mean distance, mm
  double largestError = 0;                     ///< of the distance, from what is prescribed, mm
};

struct WarpReport {
  /// Nothing stands against using the product.
  [[nodiscard]] bool isOk() const { return reasons.empty(); }
  std::vector<Finding> reasons;   ///< warp-ease, warp-inside, warp-fold, warp-crossing
  std::vector<Finding> findings;  ///< product-crosses-body
  std::vector<WarpedGirth> girths;
  /// How much the distance changed, mm, of vertices that were near the body.
  double meanEaseChange = 0, easeChange95 = 0;
  double deepestBefore = 0, deepestAfter = 0;  ///< of points inside the body, mm; 0 = none is
  double deeper = 0;      ///< most that a point inside lies deeper than before, mm
  std::size_t folds = 0;  ///< edges along which the product turns back on itself, and did not
  std::size_t crossings = 0, crossingsBefore = 0;  ///< pairs of the product's own faces
  double leastAreaRatio = 1, mostAreaRatio = 1;    ///< of a face, to before
};

struct Warp {
  ReferenceModel product;  ///< the product's names and connectivity
  WarpReport report;
};

/// Warps the shape that stands around body A to stand around body B: a last around another foot, a
/// dress block around another body.
///
/// The map from body to body is carried on to all of space by a triharmonic interpolation, so that
/// the product follows smoothly. Then it settles: near the body it regains the distance that it had
/// as well as smoothness allows, at the girths exactly, and it leaves the body wherever it would be
/// inside; rigid parts find the motion that suits their surroundings best. What comes out is
/// measured anew and judged.
///
/// Of equal bodies it is the identity, and it commutes with rigid motions of B. Equal input gives
/// equal output, for any number of threads.
///
/// @param product  closed or open; may pass through the body in places, as a last through the
/// ankle.
/// @param a, b     bodies; closed, at least where the product is, so that inside can be told
/// @param map      from `a` to `b`
/// @return the product, good or not: see `report`. An Error where none can be made:
///   InvalidArgument  no product around A: most of it is inside, or far away; a part without extent
///   UnitsMissing     product and body differ so much in size that one has another unit
///   Cancelled
/// @par Cost  about 2 s for a last of 16k faces around a foot of 37k
/// @see docs/warping.md; Wang, Hui and Tong, "Volume Parameterization for Design Automation of
///   Customized Free-Form Products", IEEE T-ASE 4(1), 2007; Duchon, "Splines minimizing
///   rotation-invariant semi-norms in Sobolev spaces", 1977.
Result<Warp> warpProduct(const ReferenceModel& product, const ReferenceModel& a,
                         const ReferenceModel& b, const Correspondence& map,
                         const WarpOptions& options = {}, Progress* progress = nullptr);

/// The report as JSON, "toile-warp" version 1 (docs/warping.md).
[[nodiscard]] std::string writeWarpReport(const Warp& warp);

}  // namespace toile
