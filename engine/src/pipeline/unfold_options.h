// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/pipeline.h"

namespace toile {

/// The options with the cloth and the grain that the design gives a piece.
[[nodiscard]] UnfoldOptions unfoldOptionsOf(const Design& design, const Piece& piece,
                                            const UnfoldOptions& options);

}  // namespace toile
