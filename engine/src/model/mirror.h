// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/model/reference_model.h"

namespace toile::detail {

/// The partner of a surface point under an exact vertex pairing; of a path, point by point. The
/// partner's partner is the point: bit for bit at vertices and inside of faces, where weights only
/// change places, and within rounding (1.2e-16 of the edge) on edges, where t may become 1 - t.
[[nodiscard]] SurfacePoint mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                                    const SurfacePoint& point);
[[nodiscard]] SurfacePath mirrored(const Mesh& mesh, const VertexData<VertexId>& partner,
                                   const SurfacePath& path);

/// The mirror image of a point: its partner where there is an exact pairing, else the closest point
/// to its reflection. CurveInvalid when the model has no symmetry.
Result<SurfacePoint> mirrored(const ReferenceModel& model, const SurfacePoint& point);

}  // namespace toile::detail
