// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cut/piece_builder.h"

namespace toile::cutting {

/// What is noteworthy about a cut: regions without a record or with several, cuts that end inside a
/// piece, curves that others hide.
[[nodiscard]] std::vector<Finding> findNoteworthy(const Document& document,
                                                  std::span<const PlacedCurve> curves,
                                                  const RefinedMesh& refined,
                                                  const VertexData<std::uint32_t>& openedAt,
                                                  std::span<const PieceBuild> builds);

/// Included pieces that cannot lie flat: tubes, closed surfaces, handles.
[[nodiscard]] std::vector<Finding> findUnflattenable(const ReferenceModel& model,
                                                     std::span<const PieceBuild> builds);

}  // namespace toile::cutting
