// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/cut/cut.h"

namespace toile::cutting {

/// refine() and cut() with further nodes: on a curve they part its edges.
Result<RefinedMesh> refineAt(const Mesh& mesh, std::span<const PlacedCurve> curves,
                             std::span<const SurfacePoint> points);
Result<CutResult> cutAt(const Document& document, std::span<const PlacedCurve> curves,
                        std::span<const SurfacePoint> points, Progress* progress);

}  // namespace toile::cutting
