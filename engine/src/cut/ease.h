// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cut/piece_builder.h"

namespace toile::cutting {

/// Sets the target lengths of cut edges and wires and the target sides of faces where the pieces'
/// ease or thickness makes them others than on the model.
/// @return NameNotFound for a direction that is neither an axis nor a curve of the model.
Result<void> applyEase(const Document& document, RefinedMesh& refined,
                       std::vector<PieceBuild>& builds);

}  // namespace toile::cutting
