// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/finish/strain.h"

namespace toile {

/// Where a vertex of a piece lies: "12 cm below the front of the neck", or by the nearest edge of
/// the piece, "4 cm from \"Side seam\", in its upper third".
[[nodiscard]] std::string placeInWords(const Document& document, const Piece& piece,
                                       const FlatPiece& flat, VertexId vertex);

/// A name of the model as people say it: "bust_point_l" is "left bust point", "neck_front" is
/// "front of the neck".
[[nodiscard]] std::string nameInWords(const std::string& name);

}  // namespace toile
