// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/curve/geodesic.h"
#include "toile/model/reference_model.h"

namespace toile::detail {

/// The partner of a surface point under an exact vertex pairing.
SurfacePoint mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                      const SurfacePoint& point);

/// The mirror image of a point: its partner where there is an exact pairing, else the closest point
/// to its reflection. CurveInvalid when the model has no symmetry.
Result<SurfacePoint> mirrored(const ReferenceModel& model, const SurfacePoint& point);

/// The mirror image of a path, point by point in the same order. Without an exact pairing the
/// points are reflected in the plane, put on the surface by closest point and linked again.
/// @return CurveInvalid when the model has no symmetry.
Result<SurfacePath> mirrored(const ReferenceModel& model, GeodesicLinker& linker,
                             const SurfacePath& path);

}  // namespace toile::detail
