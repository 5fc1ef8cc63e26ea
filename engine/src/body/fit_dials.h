// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "body/form.h"
#include "body/tape.h"

namespace toile::body {

/// Turns the dials until every measure is met.
/// @return the cage of the surface, or nullopt when Newton's method did not come within kMetMm.
std::optional<Points> fitDials(const Form& form, const Measures& wanted);

inline constexpr double kMetMm = 0.2;

/// The measures of the form with all dials at zero, at a height.
Measures standardMeasures(const Form& form, double height);

}  // namespace toile::body
