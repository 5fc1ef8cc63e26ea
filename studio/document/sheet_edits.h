// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "toile/layout/pattern.h"

namespace toile::studio {

/// Turns the grain of a piece, counter-clockwise on the piece.
std::optional<Document> withGrainTurned(const Document& document, const Pattern& pattern,
                                        const std::string& piece, Angle by);

}  // namespace toile::studio
