// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "toile/layout/pattern.h"

namespace toile::studio {

/// Changes the record of a piece; a piece without one gets it, anchored deep inside. Ids of the new
/// record follow from its name where it has one.
/// @param pattern the last full one of this document
/// @return nothing when the pattern has no such piece
std::optional<Document> withPieceRecord(const Document& document, const Pattern& pattern,
                                        const std::string& piece,
                                        const std::function<void(PieceRecord&)>& change);

/// Changes a curve of the design in place; what its way and points are stays.
std::optional<Document> withCurve(const Document& document, const std::string& curve,
                                  const std::function<void(StylingCurve&)>& change);

/// A word as an id: letters, digits and dashes; never empty, not among those taken.
[[nodiscard]] std::string makePieceId(const std::string& name, const Design& design);

}  // namespace toile::studio
