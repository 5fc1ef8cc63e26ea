// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "finish/polygon.h"
#include "toile/layout/pattern.h"

namespace toile {

/// What a machine does along a line, in the order in which it is done.
enum class MachineTask { Engrave, Mark, Cut };

struct MachineLine {
  MachineTask task = MachineTask::Mark;
  Points2 points;  ///< mm, on the sheet
  bool closed = false;
};

/// All lines of all pieces, piece by piece: texts as strokes, then what is drawn, then notches,
/// holes and last the outline, so that a piece lies still until it is done. Slit notches and the
/// like are cut; T notches are drawn.
[[nodiscard]] std::vector<std::vector<MachineLine>> machineLines(const Pattern& pattern);

}  // namespace toile
