// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include "body/tape.h"

namespace toile::body {

/// How bodies vary: the log of each measure about that of the standard body of the same form and
/// height is a Gaussian with a few common causes (stoutness, hips, muscle, bones) and a part of its
/// own. What is not given is expected at the mean that the given ones leave.
///
/// @param standard of the form at the given height
/// @param given mm
/// @return every measure, mm; the given ones as they are
Measures expectedMeasures(const Measures& standard, const std::map<BodyMeasure, double>& given);

/// By what factor a measure may lie above (and one over it, below) what the others lead to expect.
double freedom(BodyMeasure measure);

}  // namespace toile::body
