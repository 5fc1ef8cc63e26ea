// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/pipeline.h"

namespace toile {

/// Makes lines that cross the middle of the model once (closed ones twice) their own mirror images
/// by its pairing of vertices, so that twins on either side meet the same points: the half beside
/// the first twin's original stays, the other becomes its image. Lines whose ends are no images of
/// each other stay as they are; so do all of a design without twins.
void makeLinesSymmetric(const Document& document, std::vector<PlacedCurve>& curves);

}  // namespace toile
