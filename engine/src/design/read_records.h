// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "design/json_object.h"
#include "toile/design/design.h"

// Each reads one record of a design file. What is wrong is noted in the place's fault; then the
// record returned is one to go on with. References to other records are not looked up.
namespace toile::detail {

SectionPlane readPlane(const JsonPlace& at);
ModelPoint readModelPoint(const JsonPlace& at);
Place readPlace(const JsonPlace& at);
std::vector<Place> readPlaces(const JsonPlace& at);
StylingCurve readCurve(const JsonPlace& at);
PieceRecord readPiece(const JsonPlace& at);
Fabric readFabric(const JsonPlace& at);

}  // namespace toile::detail
