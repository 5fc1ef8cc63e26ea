// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QVector>
#include <QWidget>

#include "toile/design/design.h"

class QApplication;

namespace toile::studio {

enum class Theme { Light, Dark };

/// The colours of the program, by what they are for.
struct Palette {
  Theme theme = Theme::Light;
  QColor window, panel, field, hover, divider, edge;
  QColor text, second, disabled;
  QColor accent, accentText, accentSoft;
  QColor good, attention, trouble;
  QColor groundCentre, groundEdge;             ///< of the body's pane
  QColor sheet, grid, gridStrong, piece;       ///< of the pattern's pane
  QColor readOut, readOutText, readOutSecond;  ///< the label at the cursor
  QColor clay;
  QColor cutLine;
  QColor selection;  ///< halo, edge of points
  QColor middle;
};

[[nodiscard]] const Palette& palette();
/// Colours and style sheet of all widgets.
void applyTheme(QApplication& app, Theme theme);

/// How lines of a kind are drawn: colour, width and dash pattern (px, on and off; empty = solid).
struct LineLook {
  QColor onBody;   ///< also on pieces in the light theme
  QColor onPiece;  ///< in this theme
  double width = 2.4;
  QVector<float> dashes;
  bool dots = false;
};
[[nodiscard]] LineLook lookOf(CurveKind kind);
/// The tint of the n-th fabric.
[[nodiscard]] QColor fabricTint(std::size_t index);
/// -1..1 of the scale.
[[nodiscard]] QColor strainColour(double t);

}  // namespace toile::studio
