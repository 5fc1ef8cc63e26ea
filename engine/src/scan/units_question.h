// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "toile/core/result.h"
#include "toile/core/units.h"

namespace toile::scanning {

// Standing people, mm: from the newly born to the tallest.
inline constexpr double kShortestPerson = 450;
inline constexpr double kTallestPerson = 2400;

/// The question which unit a file is in, with what each would make of a length in it.
///
/// @param what     "tall" or "across"
/// @param number   that length in the file's own numbers
/// @param taken    the unit that was given, if any
/// @param isPerson units that make no person of it are left out, unless none does
[[nodiscard]] Error askForUnit(const std::string& name, const std::string& what, double number,
                               std::optional<FileUnit> taken, bool isPerson);

}  // namespace toile::scanning
