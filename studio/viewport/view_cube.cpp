// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/view_cube.h"

#include <Eigen/Geometry>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <array>

#include "app/palette.h"
#include "viewport/viewport.h"

namespace toile::studio {

using Eigen::Vector3d;

struct ViewCube::Side {
  StandardView view;
  QString letter;
  QPolygonF outline;
  double facing = 0;
  QTransform onSide;  ///< from a unit square to the side
};

ViewCube::ViewCube(Viewport& viewport) : QWidget(&viewport), viewport_(viewport) {
  setFixedSize(54, 54);
  setCursor(Qt::ArrowCursor);
  setToolTip(tr("Click a side to look from there  (1 to 6)"));
  setAccessibleName(tr("View cube"));
  connect(&viewport, &Viewport::cameraChanged, this, [this] { update(); });
}

std::vector<ViewCube::Side> ViewCube::visibleSides() const {
  struct Kind {
    StandardView view;
    QString letter;
    Vector3d normal, right;
  };
  const std::array<Kind, 6> kinds = {{
      {StandardView::Front, tr("F", "front side of the view cube"), {0, -1, 0}, {1, 0, 0}},
      {StandardView::Back, tr("B", "back side of the view cube"), {0, 1, 0}, {-1, 0, 0}},
      {StandardView::Left, tr("L", "left side of the view cube"), {1, 0, 0}, {0, 1, 0}},
      {StandardView::Right, tr("R", "right side of the view cube"), {-1, 0, 0}, {0, -1, 0}},
      {StandardView::Top, tr("T", "top of the view cube"), {0, 0, 1}, {1, 0, 0}},
      {StandardView::Bottom, tr("U", "underside of the view cube"), {0, 0, -1}, {1, 0, 0}},
  }};
  const View view = viewport_.camera().view();
  const Vector3d back = (view.eye - view.target).normalized();
  const Vector3d right = view.up.cross(back).normalized(), up = back.cross(right);
  const auto at = [&](const Vector3d& p) {
    constexpr double kHalf = 15;
    return QPointF(27 + kHalf * p.dot(right), 27 - kHalf * p.dot(up));
  };
  std::vector<Side> sides;
  for (const Kind& kind : kinds) {
    const double facing = kind.normal.dot(back);
    if (facing < 0.05) continue;
    const Vector3d across = kind.right, upward = kind.normal.cross(kind.right);
    Side side{kind.view, kind.letter, {}, facing, {}};
    side.outline << at(kind.normal - across + upward) << at(kind.normal + across + upward)
                 << at(kind.normal + across - upward) << at(kind.normal - across - upward);
    QTransform::squareToQuad(side.outline, side.onSide);
    sides.push_back(side);
  }
  return sides;
}

void ViewCube::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& colours = studio::palette();
  for (const Side& side : visibleSides()) {
    QColor fill = colours.panel;
    painter.setBrush(fill.darker(static_cast<int>(100 + 14 * (1 - side.facing))));
    painter.setPen(QPen(colours.edge, 1.2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolygon(side.outline);
    if (side.facing < 0.25) continue;
    QPainterPath letter;
    QFont font = painter.font();
    font.setPixelSize(60);
    font.setBold(true);
    letter.addText(0, 0, font, side.letter);
    const QRectF box = letter.boundingRect();
    QTransform place;
    place.translate(0.5, 0.5);
    place.scale(0.009, 0.009);
    place.translate(-box.center().x(), -box.center().y());
    painter.fillPath((place * side.onSide).map(letter), colours.text);
  }
}

void ViewCube::mousePressEvent(QMouseEvent* event) {
  for (const Side& side : visibleSides()) {
    if (side.outline.containsPoint(event->position(), Qt::OddEvenFill)) {
      return viewport_.lookFrom(side.view);
    }
  }
}

}  // namespace toile::studio
