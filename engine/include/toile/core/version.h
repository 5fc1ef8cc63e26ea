// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace toile {

/// The version of Toile as "major.minor.patch"; written into files, printed by `toile --version`.
const char* version();

}  // namespace toile
