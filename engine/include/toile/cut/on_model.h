// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/cut/cut.h"

namespace toile {

/// A point of the piece's mesh as one of the model.
[[nodiscard]] SurfacePoint pointOnModel(const Piece& piece, const Mesh& model,
                                        const SurfacePoint& point);

/// A row of points of the piece as a curve of the design, linked the shortest way.
[[nodiscard]] StylingCurve makeCurveOnModel(const Piece& piece, const Mesh& model,
                                            const std::vector<SurfacePoint>& points, std::string id,
                                            std::string name, CurveKind kind);

}  // namespace toile
