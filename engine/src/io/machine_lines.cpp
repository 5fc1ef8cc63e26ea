// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/machine_lines.h"

#include <algorithm>

#include "io/sheet_drawing.h"
#include "io/stroke_font.h"

namespace toile {
namespace {

constexpr double kCapitalsOfEm = 0.73;  // of DejaVu Sans, in which the texts are laid out
/// Stroke letters are wider than those the texts were fitted with.
constexpr double kStrokeSize = 0.78;

}  // namespace

std::vector<std::vector<MachineLine>> machineLines(const Pattern& pattern) {
  const SheetDrawing sheet = drawSheet(pattern);
  std::vector<std::vector<MachineLine>> pieces;
  for (std::size_t i = 0; i < sheet.pieces.size(); ++i) {
    const PieceDrawing& drawing = sheet.pieces[i];
    std::vector<MachineLine>& lines = pieces.emplace_back();
    for (const SheetText& text : drawing.texts)
      for (Points2& stroke : strokeText(text.text, text.position,
                                        kStrokeSize * kCapitalsOfEm * text.size, text.angle))
        lines.push_back({MachineTask::Engrave, std::move(stroke), false});
    std::vector<MachineLine> notches;
    std::vector<MachineLine> outlines;
    std::size_t notch = 0;
    for (const SheetLine& line : drawing.lines) {
      if (line.style.width <= 0) continue;
      if (line.role == SheetRole::Cut) {
        outlines.push_back({MachineTask::Cut, line.points, line.closed});
      } else if (line.role == SheetRole::Notch) {
        const NotchKind kind = pattern.pieces[i].notches[notch++].kind;
        const bool isDrawn = kind == NotchKind::T;
        notches.push_back(
            {isDrawn ? MachineTask::Mark : MachineTask::Cut, line.points, line.closed});
      } else {
        lines.push_back({MachineTask::Mark, line.points, line.closed});
      }
    }
    std::stable_sort(notches.begin(), notches.end(),
                     [](const auto& a, const auto& b) { return a.task < b.task; });
    lines.insert(lines.end(), notches.begin(), notches.end());
    // The first loop is the outer one.
    lines.insert(lines.end(), outlines.rbegin(), outlines.rend());
  }
  return pieces;
}

}  // namespace toile
