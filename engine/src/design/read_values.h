// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "design/json_object.h"
#include "toile/core/content_hash.h"
#include "toile/core/units.h"

// Single values of a design file. What is not allowed is noted in the place's fault; then the value
// returned is one to go on with.
namespace toile::detail {

/// Letters a-z A-Z, digits, "_" and "-".
std::string readId(const JsonPlace& at);
/// Any text but the empty one.
std::string readName(const JsonPlace& at);
Length readLength(const JsonPlace& at);
Length readLengthFrom(const JsonPlace& at, Length least, bool orEqual = true);
/// low..high, both included.
Length readLengthIn(const JsonPlace& at, Length low, Length high);
/// Of a seam: 0..kMostAllowance.
Length readAllowance(const JsonPlace& at);
/// low..high, both included.
Ratio readRatio(const JsonPlace& at, double low, double high);
/// Any vector but the zero one.
Eigen::Vector3d readDirection(const JsonPlace& at);
/// 32 hexadecimal digits.
ContentHash readHash(const JsonPlace& at);

}  // namespace toile::detail
