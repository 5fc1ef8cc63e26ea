// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/card.h"

#include <QPainter>
#include <QPainterPath>

#include "app/palette.h"

namespace toile::studio {

namespace {

constexpr int kWords = 54;  // px below the picture
constexpr qreal kRadius = 9;

}  // namespace

Card::Card(const QString& title, const QString& line, const QPixmap& picture, const QSize& size)
    : line_(line), picture_(picture), size_(size) {
  setText(title);
  setAccessibleName(title);
  setAccessibleDescription(line);
  setFixedSize(size);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setAttribute(Qt::WA_Hover);
}

void Card::paintEvent(QPaintEvent*) {
  const Palette& colours = studio::palette();
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
  QPainterPath outline;
  outline.addRoundedRect(box, kRadius, kRadius);
  painter.fillPath(outline, underMouse() ? colours.hover : colours.field);
  const QRectF room(box.left(), box.top(), box.width(), box.height() - kWords);
  painter.save();
  painter.setClipPath(outline);
  painter.fillRect(room, colours.theme == Theme::Light ? QColor("#E6E3DE") : colours.groundCentre);
  if (!picture_.isNull()) {
    // The middle of the picture fills the room; of a standing body that is the trunk.
    const qreal scale =
        std::max(room.width() / picture_.width(), room.height() / picture_.height());
    const QSizeF seen(room.width() / scale, room.height() / scale);
    const QRectF from(
        QPointF(0.5 * (picture_.width() - seen.width()), 0.5 * (picture_.height() - seen.height())),
        seen);
    painter.drawPixmap(room, picture_, from);
  }
  painter.restore();
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  painter.setFont(bold);
  painter.setPen(colours.text);
  const QRectF words(box.left() + 12, room.bottom() + 9, box.width() - 24, 18);
  painter.drawText(words, Qt::AlignVCenter,
                   QFontMetrics(bold).elidedText(text(), Qt::ElideRight, int(words.width())));
  QFont small = font();
  small.setPixelSize(12);
  painter.setFont(small);
  painter.setPen(colours.second);
  painter.drawText(words.translated(0, 19), Qt::AlignVCenter,
                   QFontMetrics(small).elidedText(line_, Qt::ElideRight, int(words.width())));
  painter.setPen(QPen(hasFocus() ? colours.accent : colours.divider, hasFocus() ? 2 : 1));
  painter.drawPath(outline);
}

}  // namespace toile::studio
