// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>

#include "app/session.h"

namespace toile::studio {

/// The tint of a piece of the cut, the same in both panes and in the list; that of the bare body
/// for one that is left out or cannot be made.
[[nodiscard]] QColor pieceTint(const Pattern& pattern, std::size_t piece, PieceColours colours);

}  // namespace toile::studio
