// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "finish/polygon.h"
#include "toile/io/sheet_drawing.h"

namespace toile {

/// What a machine does along a line, in the order in which it is done.
enum class MachineTask { Engrave, Mark, Cut };

struct MachineLine {
  MachineTask task = MachineTask::Mark;
  Points2 points;  ///< mm, on the sheet
  bool closed = false;
};

/// All lines of a piece: texts as strokes, then what is drawn, then notches, holes and last the
/// outline, so that the piece lies still until it is done. Slit notches and the like are cut; T
/// notches are drawn.
[[nodiscard]] std::vector<MachineLine> machineLines(const PieceDrawing& drawing);

}  // namespace toile
