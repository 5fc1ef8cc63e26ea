// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/machine_lines.h"

#include <algorithm>

#include "io/stroke_font.h"

namespace toile {
namespace {

constexpr double kCapitalsOfEm = 0.73;  // of DejaVu Sans, in which the texts are laid out
/// Stroke letters are wider than those the texts were fitted with.
constexpr double kStrokeSize = 0.78;

}  // namespace

std::vector<MachineLine> machineLines(const PieceDrawing& drawing) {
  std::vector<MachineLine> lines;
  for (const SheetText& text : drawing.texts)
    for (Points2& stroke :
         strokeText(text.text, text.position, kStrokeSize * kCapitalsOfEm * text.size, text.angle))
      lines.push_back({MachineTask::Engrave, std::move(stroke), false});
  std::vector<MachineLine> notches;
  std::vector<MachineLine> outlines;
  for (const SheetLine& line : drawing.lines) {
    if (line.pen.width <= 0) continue;
    const MachineTask task = line.isCut ? MachineTask::Cut : MachineTask::Mark;
    std::vector<MachineLine>& list = line.role == SheetRole::Cut     ? outlines
                                     : line.role == SheetRole::Notch ? notches
                                                                     : lines;
    list.push_back({task, line.points, line.closed});
  }
  std::stable_sort(notches.begin(), notches.end(),
                   [](const auto& a, const auto& b) { return a.task < b.task; });
  lines.insert(lines.end(), notches.begin(), notches.end());
  // The first loop is the outer one.
  lines.insert(lines.end(), outlines.rbegin(), outlines.rend());
  return lines;
}

}  // namespace toile
