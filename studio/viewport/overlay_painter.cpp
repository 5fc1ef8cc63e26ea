// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/overlay_painter.h"

#include <QFontMetricsF>
#include <algorithm>

#include "app/palette.h"
#include "tools/picking.h"

namespace toile::studio {

using Eigen::Vector2d;

namespace {

QFont textFont(const QPainter& painter, bool bold) {
  QFont font = painter.font();
  font.setPixelSize(12);
  font.setBold(bold);
  return font;
}

void paintPoint(QPainter& painter, const OverlayPoint& point, const QPointF& at,
                bool isTurnedAway) {
  const QColor blue("#1558D6");
  if (isTurnedAway) {  // round the body: a ring
    painter.setPen(QPen(blue, 1.5));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(at, 4, 4);
    return;
  }
  switch (point.shape) {
    case OverlayPoint::Shape::Control:
      painter.setPen(QPen(blue, 2));
      painter.setBrush(Qt::white);
      painter.drawRect(QRectF(at.x() - 4, at.y() - 4, 8, 8));
      break;
    case OverlayPoint::Shape::Active:
      painter.setPen(QPen(Qt::white, 1.5));
      painter.setBrush(blue);
      painter.drawRect(QRectF(at.x() - 5, at.y() - 5, 10, 10));
      break;
    case OverlayPoint::Shape::TwinControl:
      painter.setPen(QPen(QColor("#16202E"), 1.5));
      painter.setBrush(Qt::white);
      painter.drawEllipse(at, 3.5, 3.5);
      break;
    case OverlayPoint::Shape::Tip:
      painter.setPen(QPen(Qt::white, 1.5));
      painter.setBrush(blue);
      painter.drawEllipse(at, 4.5, 4.5);
      break;
  }
}

void paintSnap(QPainter& painter, const SnapMark& mark, const QPointF& at) {
  const QColor colour = mark.kind == SnapMark::Kind::Middle ? QColor("#5A2CB0") : QColor("#1558D6");
  painter.setBrush(Qt::NoBrush);
  const auto shape = [&] {
    switch (mark.kind) {
      case SnapMark::Kind::End:
      case SnapMark::Kind::Control:
        painter.drawRect(QRectF(at.x() - 7, at.y() - 7, 14, 14));
        break;
      case SnapMark::Kind::Line:
      case SnapMark::Kind::ModelCurve:
        painter.drawPolygon(QPolygonF({{at.x(), at.y() - 8.5},
                                       {at.x() + 8.5, at.y()},
                                       {at.x(), at.y() + 8.5},
                                       {at.x() - 8.5, at.y()}}));
        break;
      case SnapMark::Kind::Crossing:
        painter.drawLine(at + QPointF(-7, -7), at + QPointF(7, 7));
        painter.drawLine(at + QPointF(-7, 7), at + QPointF(7, -7));
        break;
      case SnapMark::Kind::Middle:
        painter.drawLine(at + QPointF(0, -10), at + QPointF(0, 10));
        break;
    }
  };
  painter.setPen(QPen(QColor(255, 255, 255, 170), 4));
  shape();
  painter.setPen(QPen(colour, 2));
  shape();

  painter.setFont(textFont(painter, false));
  const QFontMetricsF metrics(painter.font());
  const double width = metrics.horizontalAdvance(mark.word) + 14;
  QRectF box(at.x() - width - 14, at.y() - 34, width, 22);
  if (box.left() < 4) box.moveLeft(at.x() + 14);
  if (box.top() < 4) box.moveTop(at.y() + 14);
  painter.setPen(QPen(palette().divider, 1));
  painter.setBrush(QColor("#FBFAF8"));
  painter.drawRoundedRect(box, 5, 5);
  painter.setPen(QColor("#1F2124"));
  painter.drawText(box, Qt::AlignCenter, mark.word);
}

}  // namespace

void paintReadOut(QPainter& painter, const std::vector<ReadOut>& rows, const QPointF& beside) {
  if (rows.empty()) return;
  const QFont plain = textFont(painter, false), bold = textFont(painter, true);
  const QFontMetricsF plainMetrics(plain), boldMetrics(bold);
  double words = 0, values = 0;
  for (const ReadOut& row : rows) {
    words = std::max(words, plainMetrics.horizontalAdvance(row.word));
    values = std::max(values, boldMetrics.horizontalAdvance(row.value));
  }
  const double lineHeight = 18;
  QRectF box(beside.x() + 18, beside.y() + 18, words + values + 30,
             lineHeight * static_cast<double>(rows.size()) + 10);
  const QRectF window(painter.window());
  if (box.right() > window.right() - 4) box.moveRight(beside.x() - 18);
  if (box.bottom() > window.bottom() - 4) box.moveBottom(beside.y() - 18);
  painter.setPen(Qt::NoPen);
  painter.setBrush(palette().readOut);
  painter.drawRoundedRect(box, 6, 6);
  double y = box.top() + 5;
  for (const ReadOut& row : rows) {
    const QRectF line(box.left() + 10, y, box.width() - 20, lineHeight);
    painter.setFont(plain);
    painter.setPen(palette().readOutSecond);
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, row.word);
    painter.setFont(bold);
    painter.setPen(palette().readOutText);
    painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter, row.value);
    y += lineHeight;
  }
}

void paintMarker(QPainter& painter, const QPointF& at, const QString& text, bool strong) {
  painter.setPen(QPen(Qt::white, 1.5));
  painter.setBrush(strong ? QColor("#A34700") : palette().readOut);
  painter.drawEllipse(at, 9, 9);
  painter.setFont(textFont(painter, true));
  painter.setPen(Qt::white);
  painter.drawText(QRectF(at.x() - 12, at.y() - 12, 24, 24), Qt::AlignCenter, text);
}

void paintToolOverlay(QPainter& painter, const Overlay& overlay, const ToolHost& host,
                      const std::optional<Vector2d>& cursor) {
  const auto pixelOf = [&](const Eigen::Vector3d& place) -> std::optional<QPointF> {
    const auto pixel = host.screen().toPixel(place);
    return pixel ? std::optional(QPointF(pixel->x(), pixel->y())) : std::nullopt;
  };
  for (const OverlayPoint& point : overlay.points) {
    const auto at = pixelOf(point.place);
    if (!at) continue;
    const bool turnedAway = point.normal.dot(host.screen().towardsEye(point.place)) < 0;
    if (!turnedAway && point.shape != OverlayPoint::Shape::Active &&
        !isVisible(host, point.place, point.normal)) {
      continue;
    }
    paintPoint(painter, point, *at, turnedAway);
  }
  if (overlay.snap) {
    if (const auto at = pixelOf(overlay.snap->place)) paintSnap(painter, *overlay.snap, *at);
  }
  for (const OverlayLabel& label : overlay.labels) {
    if (const auto at = pixelOf(label.place)) paintReadOut(painter, label.rows, *at);
  }
  if (cursor) paintReadOut(painter, overlay.readOut, {cursor->x(), cursor->y()});
}

}  // namespace toile::studio
