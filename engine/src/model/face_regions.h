// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "toile/model/reference_model.h"

namespace toile::detail {

/// A number per face, from 0 on without gaps.
using FaceRegions = FaceData<std::uint32_t>;

/// The face that mirrors each face; empty where the model has no pairing.
[[nodiscard]] FaceData<FaceId> mirroredFaces(const ReferenceModel& model);

/// Faces joined across edges that are no borders, numbered by their smallest face.
[[nodiscard]] FaceRegions connectedFaces(const Mesh& mesh,
                                         const std::function<bool(EdgeId)>& isBorder);

/// Gives what is no part of a region's largest connected part, and every region of less than
/// `share` of the whole area, to the neighbour that it shares most of its border with.
[[nodiscard]] FaceRegions mergedParts(const Mesh& mesh, const FaceRegions& regions, double share);
/// The same, then every connected part a region, numbered by its smallest face.
[[nodiscard]] FaceRegions tidyRegions(const Mesh& mesh, const FaceRegions& regions, double share);

/// Between sharp turns of the surface.
[[nodiscard]] FaceRegions regionsBySharpTurns(const Mesh& mesh);
/// Between paths on the surface.
[[nodiscard]] FaceRegions regionsBetween(const Mesh& mesh, std::span<const SurfacePath> borders);

/// Parts every region that turns away from itself in two, by a minimum cut.
[[nodiscard]] FaceRegions partTurnedRegions(const ReferenceModel& model, const FaceRegions& regions,
                                            const FaceData<FaceId>& mirrored);

/// Parts each chosen region in two where it bends most, its mirror image alike.
[[nodiscard]] FaceRegions partRegions(const ReferenceModel& model, const FaceRegions& regions,
                                      const std::vector<char>& isChosen,
                                      const FaceData<FaceId>& mirrored);

}  // namespace toile::detail
