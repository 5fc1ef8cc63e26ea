// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern_painter.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "app/palette.h"
#include "document/strain_spots.h"
#include "viewport/overlay_painter.h"

namespace toile::studio {

namespace {

constexpr double kLeastForGrain = 40;  // px of a piece
constexpr double kTint = 0.3;          // how much of its tint a piece shows

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto mix = [&](int x, int y) { return static_cast<int>(std::lround(x + share * (y - x))); };
  return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
}

struct Words {
  Q_DECLARE_TR_FUNCTIONS(PatternView)
};

}  // namespace

QPointF SheetView::toSheet(const QPointF& pixel) const {
  return {centre.x() + (pixel.x() - 0.5 * size.width()) / scale,
          centre.y() - (pixel.y() - 0.5 * size.height()) / scale};
}

QPointF SheetView::toPixel(const QPointF& sheet) const {
  return {0.5 * size.width() + (sheet.x() - centre.x()) * scale,
          0.5 * size.height() - (sheet.y() - centre.y()) * scale};
}

QTransform SheetView::transform() const {
  QTransform toWindow;
  toWindow.translate(0.5 * size.width(), 0.5 * size.height());
  toWindow.scale(scale, -scale);
  toWindow.translate(-centre.x(), -centre.y());
  return toWindow;
}

QPointF turnHandle(const DrawnPiece& piece, const SheetView& view) {
  const QRectF box = piece.cut.boundingRect();
  return view.toPixel({box.center().x(), box.bottom()}) - QPointF(0, 20);
}

void PatternPainter::paintGround() {
  const Palette& colours = studio::palette();
  painter_.fillRect(QRectF({0, 0}, view_.size), colours.sheet);
  const QPointF low = view_.toSheet({0, view_.size.height()}),
                high = view_.toSheet({view_.size.width(), 0});
  const auto lines = [&](double step, const QColor& colour) {
    painter_.setPen(QPen(colour, 1));
    for (double x = std::ceil(low.x() / step) * step; x < high.x(); x += step) {
      const double px = std::round(view_.toPixel({x, 0}).x()) + 0.5;
      painter_.drawLine(QPointF(px, 0), QPointF(px, view_.size.height()));
    }
    for (double y = std::ceil(low.y() / step) * step; y < high.y(); y += step) {
      const double px = std::round(view_.toPixel({0, y}).y()) + 0.5;
      painter_.drawLine(QPointF(0, px), QPointF(view_.size.width(), px));
    }
  };
  painter_.setRenderHint(QPainter::Antialiasing, false);
  if (view_.scale >= 1.2) lines(10, colours.grid);
  if (view_.scale >= 0.08) lines(50, colours.grid);
  lines(view_.scale >= 0.08 ? 100 : 500, colours.gridStrong);
  painter_.setRenderHint(QPainter::Antialiasing, true);
}

void PatternPainter::paintRulers() {
  const Palette& colours = studio::palette();
  painter_.setRenderHint(QPainter::Antialiasing, false);
  painter_.fillRect(QRectF(0, 0, view_.size.width(), kRuler), colours.panel);
  painter_.fillRect(QRectF(0, 0, kRuler, view_.size.height()), colours.panel);
  painter_.setPen(colours.divider);
  painter_.drawLine(QPointF(0, kRuler), QPointF(view_.size.width(), kRuler));
  painter_.drawLine(QPointF(kRuler, 0), QPointF(kRuler, view_.size.height()));
  QFont font = painter_.font();
  font.setPixelSize(10);
  painter_.setFont(font);
  painter_.setPen(colours.second);
  const bool inch = session_.unit() == LengthUnit::Inch;
  const double unit = inch ? 25.4 : 10;
  double step = 1;
  for (const double candidate : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0}) {
    step = candidate;
    if (candidate * unit * view_.scale >= 44) break;
  }
  const QPointF low = view_.toSheet({0, view_.size.height()}),
                high = view_.toSheet({view_.size.width(), 0});
  const double mm = step * unit;
  for (double x = std::ceil(low.x() / mm) * mm; x < high.x(); x += mm) {
    const double px = std::round(view_.toPixel({x, 0}).x());
    if (px < kRuler) continue;
    painter_.drawLine(QPointF(px, kRuler - 6), QPointF(px, kRuler));
    painter_.drawText(QRectF(px - 20, 1, 40, 14), Qt::AlignCenter,
                      QString::number(std::lround(x / unit)));
  }
  for (double y = std::ceil(low.y() / mm) * mm; y < high.y(); y += mm) {
    const double px = std::round(view_.toPixel({0, y}).y());
    if (px < kRuler) continue;
    painter_.drawLine(QPointF(kRuler - 6, px), QPointF(kRuler, px));
    painter_.save();
    painter_.translate(8, px);
    painter_.rotate(-90);
    painter_.drawText(QRectF(-20, -7, 40, 14), Qt::AlignCenter,
                      QString::number(std::lround(y / unit)));
    painter_.restore();
  }
  painter_.fillRect(QRectF(0, 0, kRuler, kRuler), colours.panel);
  painter_.drawText(QRectF(0, 0, kRuler, kRuler), Qt::AlignCenter,
                    inch ? QStringLiteral("in") : QStringLiteral("cm"));
  painter_.setRenderHint(QPainter::Antialiasing, true);
}

void PatternPainter::paintRun(const DrawnRun& run, const QTransform& toWindow, double width,
                              bool isPreview) {
  const QPolygonF line = toWindow.map(run.points);
  const bool picked = session_.selection().isLine(run.curve);
  if (picked || session_.hover().isLine(run.curve)) {
    QColor glow = studio::palette().selection;
    glow.setAlphaF(picked ? 0.5F : 0.25F);
    painter_.setPen(QPen(glow, 8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter_.drawPolyline(line);
  }
  const LineLook look = lookOf(run.kind);
  QPen pen(look.onPiece, width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
  if (isPreview) {
    pen.setDashPattern({5 / width, 3 / width});
  } else if (look.dots) {
    pen.setCapStyle(Qt::RoundCap);
    pen.setDashPattern({0.01, look.dashes[1] / width});
  } else if (!look.dashes.isEmpty()) {
    QVector<qreal> dashes;
    for (const float dash : look.dashes) dashes << dash / width;
    pen.setDashPattern(dashes);
  }
  painter_.setPen(pen);
  painter_.drawPolyline(line);
}

void PatternPainter::paintGrain(const QLineF& grain) {
  painter_.setPen(QPen(studio::palette().second, 1.1));
  painter_.drawLine(grain);
  for (const bool atEnd : {false, true}) {
    QLineF arm(atEnd ? grain.p2() : grain.p1(), atEnd ? grain.p1() : grain.p2());
    arm.setLength(6);
    for (const double turn : {28.0, -28.0}) {
      QLineF barb = arm;
      barb.setAngle(arm.angle() + turn);
      painter_.drawLine(barb);
    }
  }
}

void PatternPainter::paintName(const DrawnPiece& piece, const QTransform& toWindow,
                               const QPainterPath& cut) {
  QFont font = painter_.font();
  font.setPixelSize(12);
  font.setBold(true);
  painter_.setFont(font);
  // On one line, or a line for each word, where that stays inside of the piece; names that run over
  // their neighbours could not be told apart. The list and the panel have every name.
  const QFontMetricsF metrics(font);
  QString words = piece.name;
  words.replace(QLatin1Char(' '), QLatin1Char('\n'));
  for (const QString& text : {piece.name, words}) {
    QRectF room = metrics.boundingRect(QRectF(0, 0, 1000, 1000), Qt::AlignCenter, text);
    room.moveCenter(toWindow.map(piece.label));
    if (!cut.contains(room)) continue;
    const bool onColours = !piece.strain.isNull();
    painter_.setPen(onColours ? QColor("#1F2124") : studio::palette().text);
    painter_.drawText(room.adjusted(-4, -2, 4, 2), Qt::AlignCenter, text);
    break;
  }
}

void PatternPainter::paintPiece(const DrawnPiece& piece, const QTransform& motion) {
  const Palette& colours = studio::palette();
  const QTransform toWindow = motion * view_.transform();
  const QPainterPath cut = toWindow.map(piece.cut), sew = toWindow.map(piece.sew);
  const bool isSelected = session_.selection().isPiece(piece.id);
  if (isSelected || session_.hover().isPiece(piece.id)) {
    QColor halo = colours.selection;
    halo.setAlphaF(isSelected ? 0.5F : 0.25F);
    painter_.strokePath(sew, QPen(halo, 9, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  }
  painter_.fillPath(shown_.allowance ? cut : sew, mixed(colours.piece, piece.tint, kTint));
  if (!piece.strain.isNull()) {
    painter_.save();
    painter_.setClipPath(sew, Qt::IntersectClip);
    painter_.setRenderHint(QPainter::SmoothPixmapTransform);
    painter_.setTransform(toWindow, /*combine=*/true);
    painter_.drawImage(piece.strainPlace, piece.strain);
    painter_.restore();
  }
  if (shown_.allowance) painter_.strokePath(cut, QPen(colours.cutLine, 0.8));
  if (shown_.features) {
    for (const DrawnRun& run : piece.inner) paintRun(run, toWindow, 1.6, piece.isPreview);
  }
  for (const DrawnRun& run : piece.runs) paintRun(run, toWindow, 1.8, piece.isPreview);
  if (shown_.notches) {
    painter_.setPen(QPen(lookOf(CurveKind::Seam).onPiece, 1.1));
    for (const QLineF& notch : piece.notches) painter_.drawLine(toWindow.map(notch));
  }
  if (shown_.grain && cut.boundingRect().width() > kLeastForGrain) {
    paintGrain(toWindow.map(piece.grain));
  }
  if (shown_.labels) paintName(piece, toWindow, cut);
}

void PatternPainter::paintMates(const std::vector<DrawnMates>& mates) {
  const QTransform toWindow = view_.transform();
  QColor colour = studio::palette().selection;
  for (const DrawnMates& each : mates) {
    painter_.setPen(QPen(colour, 1, Qt::DotLine));
    for (const QLineF& line : each.connectors) painter_.drawLine(toWindow.map(line));
  }
  const auto longest =
      std::ranges::max_element(mates, {}, [](const DrawnMates& each) { return each.a->length; });
  if (longest == mates.end()) return;
  const QLineF middle = toWindow.map(longest->connectors[longest->connectors.size() / 2]);
  paintReadOut(painter_,
               {{Words::tr("seam"), session_.lengthText(longest->a->length)},
                {Words::tr("mate"), session_.lengthText(longest->b->length)}},
               middle.center() - QPointF(40, 18));
}

void PatternPainter::paintHandles(const DrawnPiece& piece, const QTransform& motion) {
  const QColor blue = studio::palette().selection;
  const QTransform toWindow = motion * view_.transform();
  if (shown_.grain) {
    painter_.setPen(QPen(blue, 2));
    painter_.setBrush(Qt::white);
    for (const QPointF& end : {piece.grain.p1(), piece.grain.p2()}) {
      painter_.drawEllipse(toWindow.map(end), 4, 4);
    }
  }
  if (!motion.isIdentity()) return;
  const QPointF ring = turnHandle(piece, view_);
  painter_.setPen(QPen(blue, 1));
  painter_.drawLine(ring + QPointF(0, 6), ring + QPointF(0, 20));
  painter_.setPen(QPen(blue, 2));
  painter_.setBrush(Qt::white);
  painter_.drawEllipse(ring, 6, 6);
}

void PatternPainter::paintSpots(const std::vector<DrawnPiece>& pieces) {
  const auto& pattern = session_.fullPattern();
  if (!session_.strainLook().on || !pattern || !session_.strains()) return;
  for (const PlacedSpot& spot :
       worstSpots(*pattern, *session_.strains(), session_.strainLook().kind)) {
    for (const DrawnPiece& piece : pieces) {
      if (piece.cutIndex != spot.piece || !pattern->flats[spot.piece]) continue;
      const Eigen::Vector2d& flat = pattern->flats[spot.piece]->position[spot.spot.vertex];
      paintMarker(painter_, view_.toPixel(toQt(piece.placement.apply(flat))),
                  QString::number(spot.number), spot.isOverLimit);
    }
  }
}

void PatternPainter::paintGhosts(const std::vector<DrawnPiece>& pieces) {
  for (const Ghost& ghost : session_.ghosts()) {
    for (const DrawnPiece& piece : pieces) {
      if (piece.id != ghost.piece || ghost.flat.empty()) continue;
      QPolygonF line;
      for (const auto& p : ghost.flat) line << view_.toPixel(toQt(piece.placement.apply(p)));
      painter_.setPen(QPen(lookOf(ghost.kind).onPiece, 2));
      painter_.setBrush(Qt::NoBrush);
      painter_.drawPolyline(line);
      paintMarker(painter_, line[line.size() / 2], ghost.label, /*strong=*/true);
    }
  }
}

}  // namespace toile::studio
