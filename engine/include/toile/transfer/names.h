// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/fit/correspondence.h"
#include "toile/model/reference_model.h"

namespace toile {

/// Gives a model the names of another: feature curves point by point and linked again, landmarks,
/// left and right, and the guiding map where one is given. What the target has already is kept.
///
/// On one connectivity the curves are the same faces and weights, and the pairing of vertices goes
/// along. On another the mirror plane is the one that fits the images of paired vertices best, and
/// there is no pairing of vertices, unless the target has one.
/// @param map from `names` to `target`
/// @return NameNotFound never; CurveInvalid when a curve cannot be linked on the target (a part of
///   it lies on another component).
/// @par Cost  a closest point and a short link for each point of a curve
Result<ReferenceModel> carryNames(const ReferenceModel& names, const ReferenceModel& target,
                                  const Correspondence& map);

}  // namespace toile
