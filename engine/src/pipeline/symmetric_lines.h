// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/pipeline.h"

namespace toile {

/// Makes lines that cross the middle of the model once (closed ones twice) their own mirror images
/// by its pairing of vertices, so that twins and the sides of symmetric pieces meet the same
/// points: the half beside the first twin's original stays (the left one without twins), the other
/// becomes its image. Lines that are farther than 10 mm from their image stay as they are; so do
/// all of a design that asks for no symmetry.
/// @param symmetricPieces symmetry is asked for, twins or not
void makeLinesSymmetric(const Document& document, bool symmetricPieces,
                        std::vector<PlacedCurve>& curves);

}  // namespace toile
