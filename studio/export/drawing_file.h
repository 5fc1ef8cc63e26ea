// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QPolygonF>
#include <QString>
#include <vector>

namespace toile::studio {

/// The strokes of a file for cutters, to be looked at: what the machine will do.
struct DrawingFile {
  struct Stroke {
    QPolygonF points;  ///< mm, y up
    QColor colour;
  };
  struct Word {
    QPointF place;
    double height = 0;
    QString text;
  };
  std::vector<Stroke> strokes;
  std::vector<Word> words;
  QStringList layers;  ///< DXF: their names as they come

  [[nodiscard]] QRectF box() const;
};

/// Lines, polylines and texts of a DXF (R12) as Toile writes it; blocks stand in their places.
[[nodiscard]] DrawingFile readDxfStrokes(const QByteArray& text);
/// SP, PU, PD of an HP-GL file: a colour for each pen, positioning in faint grey.
[[nodiscard]] DrawingFile readHpglStrokes(const QByteArray& text);

}  // namespace toile::studio
