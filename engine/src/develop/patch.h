// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "toile/develop/darts.h"

namespace toile::developing {

/// A piece as a patch whose chains are its wires, named by their place in the piece's list.
[[nodiscard]] Patch patchOf(const Piece& piece);

/// What the ids of darts that are tried begin with.
inline constexpr std::string_view kProposal = "proposal";

/// Gives a piece of re-cut faces the target sides of the faces it was cut from, and the darts that
/// are tried their mean scale.
void takeTargetSides(const Piece& from, const FaceData<FaceId>& source, Piece& to);

/// The parts of a piece that hang together, as pieces of their own.
[[nodiscard]] Result<std::vector<Piece>> partsOf(const Piece& piece);

}  // namespace toile::developing
