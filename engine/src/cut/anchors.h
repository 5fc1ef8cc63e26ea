// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/cut/cut.h"

namespace toile::cutting {

/// The face of the refined mesh that holds a point of the model; on an edge, the one in its first
/// face.
[[nodiscard]] FaceId findRefinedFace(const Mesh& model, const RefinedMesh& refined,
                                     const SurfacePoint& point);

/// Gives regions their records: which records lie in each region, ascending.
/// @param regionOfFace  by face of the refined mesh.
/// @return an Error naming the record whose anchor is nowhere.
Result<std::vector<std::vector<int>>> assignRecords(const Document& document,
                                                    const std::vector<PlacedCurve>& curves,
                                                    const RefinedMesh& refined,
                                                    const FaceData<std::uint32_t>& regionOfFace,
                                                    std::size_t regionCount);

}  // namespace toile::cutting
