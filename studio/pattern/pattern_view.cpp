// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "app/palette.h"

namespace toile::studio {

namespace {

constexpr double kRuler = 22;     // px
constexpr double kLineCatch = 8;  // px
constexpr double kClick = 4;      // px that a click may move

QPointF point(const Eigen::Vector2d& p) {
  return {p.x(), p.y()};
}

QPainterPath pathOf(const std::vector<Outline>& outlines, const Placement& placement) {
  QPainterPath path;
  for (const Outline& outline : outlines) {
    QPolygonF polygon;
    for (const OutlinePoint& p : outline) polygon << point(placement.apply(p.position));
    if (polygon.isEmpty()) continue;
    path.addPolygon(polygon);
    path.closeSubpath();
  }
  return path;
}

CurveKind kindOf(WireKind kind) {
  switch (kind) {
    case WireKind::Opening:
      return CurveKind::Opening;
    case WireKind::Dart:
      return CurveKind::Dart;
    case WireKind::Feature:
      return CurveKind::Feature;
    case WireKind::Elastic:
      return CurveKind::Elastic;
    case WireKind::Seam:
    case WireKind::Border:
      return CurveKind::Seam;
  }
  return CurveKind::Seam;
}

double distanceTo(const QPolygonF& line, const QPointF& p) {
  double best = 1e9;
  for (int i = 1; i < line.size(); ++i) {
    const QPointF a = line[i - 1], d = line[i] - a;
    const double squared = QPointF::dotProduct(d, d);
    const double t =
        squared == 0 ? 0 : std::clamp(QPointF::dotProduct(p - a, d) / squared, 0.0, 1.0);
    const QPointF off = p - (a + t * d);
    best = std::min(best, std::hypot(off.x(), off.y()));
  }
  return best;
}

}  // namespace

PatternView::PatternView(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(360, 300);
  setAccessibleName(tr("Pattern"));
  setObjectName(QStringLiteral("pattern"));
  connect(&session, &Session::patternChanged, this, &PatternView::takePattern);
  connect(&session, &Session::selectionChanged, this, [this] { update(); });
  connect(&session, &Session::hoverChanged, this, [this] { update(); });
}

void PatternView::takePattern() {
  pieces_.clear();
  box_ = {};
  if (const auto pattern = session_.pattern()) {
    for (std::size_t i = 0; i < pattern->pieces.size(); ++i) {
      const PatternPiece& piece = pattern->pieces[i];
      const Placement& placement = pattern->layout.placements[i];
      Drawn drawn;
      drawn.id = piece.id;
      drawn.name = QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
      drawn.sew = pathOf(piece.sewLines, placement);
      drawn.cut = pathOf(piece.cutLines, placement);
      for (const OutlineRun& run : piece.runs) {
        const Outline& loop = piece.sewLines[run.loop];
        Run line{run.curve, {}, kindOf(run.kind)};
        for (std::size_t k = 0; k <= run.edgeCount; ++k) {
          line.points << point(placement.apply(loop[(run.first + k) % loop.size()].position));
        }
        drawn.runs.push_back(std::move(line));
      }
      for (const InternalLine& inner : piece.internalLines) {
        Run line{inner.curve, {}, inner.kind};
        for (const auto& p : inner.points) line.points << point(placement.apply(p));
        if (inner.closed && !line.points.isEmpty()) line.points << line.points.first();
        drawn.inner.push_back(std::move(line));
      }
      for (const Notch& notch : piece.notches) {
        const auto from = placement.apply(notch.position);
        const auto to = placement.apply(notch.position + notch.depth * notch.direction);
        drawn.notches.emplace_back(point(from), point(to));
      }
      drawn.grain = {point(placement.apply(piece.grain[0])),
                     point(placement.apply(piece.grain[1]))};
      drawn.label = point(placement.apply(piece.labelPosition));
      if (piece.count != 1) drawn.note = QStringLiteral("× %1").arg(piece.count);
      box_ = box_.united(drawn.cut.boundingRect());
      pieces_.push_back(std::move(drawn));
    }
  }
  if (fitted_) fitAll();
  // A preview at once: an update waits for its turn as long as the mouse keeps moving.
  if (session_.isPatternPreview() && isVisible()) return repaint();
  update();
}

void PatternView::fitAll() {
  fitted_ = true;
  if (box_.isEmpty() || width() < 2 * kRuler) return;
  const double room = 28;
  scale_ = std::min((width() - kRuler - 2 * room) / box_.width(),
                    (height() - kRuler - 2 * room) / box_.height());
  scale_ = std::clamp(scale_, 0.01, 5.0);
  centre_ = box_.center() - QPointF(kRuler / 2, -kRuler / 2) / scale_;
  Q_EMIT scaleChanged();
  update();
}

QPointF PatternView::toSheet(const QPointF& pixel) const {
  return {centre_.x() + (pixel.x() - 0.5 * width()) / scale_,
          centre_.y() - (pixel.y() - 0.5 * height()) / scale_};
}

QPointF PatternView::toPixel(const QPointF& sheet) const {
  return {0.5 * width() + (sheet.x() - centre_.x()) * scale_,
          0.5 * height() - (sheet.y() - centre_.y()) * scale_};
}

void PatternView::resizeEvent(QResizeEvent*) {
  if (fitted_) fitAll();
}

void PatternView::paintGround(QPainter& painter) const {
  const Palette& colours = studio::palette();
  painter.fillRect(rect(), colours.sheet);
  const QPointF low = toSheet({0, double(height())}), high = toSheet({double(width()), 0});
  const auto lines = [&](double step, const QColor& colour) {
    painter.setPen(QPen(colour, 1));
    for (double x = std::ceil(low.x() / step) * step; x < high.x(); x += step) {
      const double px = std::round(toPixel({x, 0}).x()) + 0.5;
      painter.drawLine(QPointF(px, 0), QPointF(px, height()));
    }
    for (double y = std::ceil(low.y() / step) * step; y < high.y(); y += step) {
      const double px = std::round(toPixel({0, y}).y()) + 0.5;
      painter.drawLine(QPointF(0, px), QPointF(width(), px));
    }
  };
  painter.setRenderHint(QPainter::Antialiasing, false);
  if (scale_ >= 1.2) lines(10, colours.grid);
  if (scale_ >= 0.08) lines(50, colours.grid);
  lines(scale_ >= 0.08 ? 100 : 500, colours.gridStrong);
  painter.setRenderHint(QPainter::Antialiasing, true);
}

void PatternView::paintRulers(QPainter& painter) const {
  const Palette& colours = studio::palette();
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.fillRect(QRectF(0, 0, width(), kRuler), colours.panel);
  painter.fillRect(QRectF(0, 0, kRuler, height()), colours.panel);
  painter.setPen(colours.divider);
  painter.drawLine(QPointF(0, kRuler), QPointF(width(), kRuler));
  painter.drawLine(QPointF(kRuler, 0), QPointF(kRuler, height()));
  QFont font = painter.font();
  font.setPixelSize(10);
  painter.setFont(font);
  painter.setPen(colours.second);
  const bool inch = session_.unit() == LengthUnit::Inch;
  const double unit = inch ? 25.4 : 10;
  double step = 1;
  for (const double candidate : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0}) {
    step = candidate;
    if (candidate * unit * scale_ >= 44) break;
  }
  const QPointF low = toSheet({0, double(height())}), high = toSheet({double(width()), 0});
  const double mm = step * unit;
  for (double x = std::ceil(low.x() / mm) * mm; x < high.x(); x += mm) {
    const double px = std::round(toPixel({x, 0}).x());
    if (px < kRuler) continue;
    painter.drawLine(QPointF(px, kRuler - 6), QPointF(px, kRuler));
    painter.drawText(QRectF(px - 20, 1, 40, 14), Qt::AlignCenter,
                     QString::number(std::lround(x / unit)));
  }
  for (double y = std::ceil(low.y() / mm) * mm; y < high.y(); y += mm) {
    const double px = std::round(toPixel({0, y}).y());
    if (px < kRuler) continue;
    painter.drawLine(QPointF(kRuler - 6, px), QPointF(kRuler, px));
    painter.save();
    painter.translate(8, px);
    painter.rotate(-90);
    painter.drawText(QRectF(-20, -7, 40, 14), Qt::AlignCenter,
                     QString::number(std::lround(y / unit)));
    painter.restore();
  }
  painter.fillRect(QRectF(0, 0, kRuler, kRuler), colours.panel);
  painter.drawText(QRectF(0, 0, kRuler, kRuler), Qt::AlignCenter,
                   inch ? QStringLiteral("in") : QStringLiteral("cm"));
  painter.setRenderHint(QPainter::Antialiasing, true);
}

void PatternView::paintPiece(QPainter& painter, const Drawn& piece) const {
  const Palette& colours = studio::palette();
  QTransform toWindow;
  toWindow.translate(0.5 * width(), 0.5 * height());
  toWindow.scale(scale_, -scale_);
  toWindow.translate(-centre_.x(), -centre_.y());
  const QPainterPath cut = toWindow.map(piece.cut), sew = toWindow.map(piece.sew);

  const Selection& selected = session_.selection();
  QColor halo = colours.selection;
  const bool isSelected = selected.isPiece(piece.id);
  if (isSelected || session_.hover().isPiece(piece.id)) {
    halo.setAlphaF(isSelected ? 0.5F : 0.25F);
    painter.strokePath(sew, QPen(halo, 9, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  }
  painter.fillPath(cut, colours.piece);
  painter.strokePath(cut, QPen(colours.cutLine, 0.8));

  const auto drawRun = [&](const Run& run, double width) {
    const QPolygonF line = toWindow.map(run.points);
    const bool picked = selected.isLine(run.curve), hovered = session_.hover().isLine(run.curve);
    if (picked || hovered) {
      QColor glow = colours.selection;
      glow.setAlphaF(picked ? 0.5F : 0.25F);
      painter.setPen(QPen(glow, 8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPolyline(line);
    }
    const LineLook look = lookOf(run.kind);
    QPen pen(look.onPiece, width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
    if (session_.isPatternPreview()) {
      pen.setDashPattern({5 / width, 3 / width});
    } else if (look.dots) {
      pen.setCapStyle(Qt::RoundCap);
      pen.setDashPattern({0.01, look.dashes[1] / width});
    } else if (!look.dashes.isEmpty()) {
      QVector<qreal> dashes;
      for (const float dash : look.dashes) dashes << dash / width;
      pen.setDashPattern(dashes);
    }
    painter.setPen(pen);
    painter.drawPolyline(line);
  };
  for (const Run& run : piece.inner) drawRun(run, 1.6);
  for (const Run& run : piece.runs) drawRun(run, 1.8);
  painter.setPen(QPen(lookOf(CurveKind::Seam).onPiece, 1.1));
  for (const QLineF& notch : piece.notches) painter.drawLine(toWindow.map(notch));

  const QRectF box = cut.boundingRect();
  if (box.width() > 40) {
    painter.setPen(QPen(colours.second, 1.1));
    const QLineF grain = toWindow.map(piece.grain);
    painter.drawLine(grain);
    for (const bool atEnd : {false, true}) {
      const QPointF tip = atEnd ? grain.p2() : grain.p1();
      QLineF arm(tip, atEnd ? grain.p1() : grain.p2());
      arm.setLength(6);
      for (const double turn : {28.0, -28.0}) {
        QLineF barb = arm;
        barb.setAngle(arm.angle() + turn);
        painter.drawLine(barb);
      }
    }
  }
  QFont font = painter.font();
  font.setPixelSize(12);
  font.setBold(true);
  painter.setFont(font);
  // On one line, or a line for each word, where that stays inside of the piece; names that run over
  // their neighbours could not be told apart. The list and the panel have every name.
  const QFontMetricsF metrics(font);
  QString words = piece.name;
  words.replace(QLatin1Char(' '), QLatin1Char('\n'));
  for (const QString& text : {piece.name, words}) {
    QRectF room = metrics.boundingRect(QRectF(0, 0, 1000, 1000), Qt::AlignCenter, text);
    room.moveCenter(toWindow.map(piece.label));
    if (!cut.contains(room)) continue;
    painter.setPen(colours.text);
    painter.drawText(room.adjusted(-4, -2, 4, 2), Qt::AlignCenter, text);
    break;
  }
}

void PatternView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paintGround(painter);
  for (const Drawn& piece : pieces_) paintPiece(painter, piece);
  if (pieces_.empty() && session_.hasWork()) {
    painter.setPen(studio::palette().second);
    const QString text =
        session_.document().design->curves.empty()
            ? tr("Nothing drawn yet. Take the pencil (P) and draw a line on the body.")
            : tr("No piece is closed yet. Lines that run from edge to edge cut a piece.");
    painter.drawText(rect().adjusted(60, 0, -40, 0), Qt::AlignCenter | Qt::TextWordWrap, text);
  }
  paintRulers(painter);
}

Selection PatternView::pick(const QPointF& pixel) const {
  const QPointF at = toSheet(pixel);
  Selection best;
  double nearest = kLineCatch / scale_;
  for (const Drawn& piece : pieces_) {
    for (const auto* runs : {&piece.runs, &piece.inner}) {
      for (const Run& run : *runs) {
        const double distance = distanceTo(run.points, at);
        if (distance >= nearest) continue;
        nearest = distance;
        best = Selection::line(run.curve);
        best.onPiece = piece.id;
      }
    }
  }
  if (best.kind != Selection::Kind::None && session_.lines().find(best.id) != nullptr) return best;
  for (const Drawn& piece : pieces_) {
    if (piece.cut.contains(at)) return Selection::piece(piece.id);
  }
  return {};
}

void PatternView::mousePressEvent(QMouseEvent* event) {
  pressedAt_ = lastAt_ = event->position();
  panning_ = false;
}

void PatternView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) return session_.setHover(pick(event->position()));
  if ((event->position() - pressedAt_).manhattanLength() > kClick) panning_ = true;
  if (panning_) {
    const QPointF step = event->position() - lastAt_;
    centre_ -= QPointF(step.x(), -step.y()) / scale_;
    fitted_ = false;
    update();
  }
  lastAt_ = event->position();
}

void PatternView::mouseReleaseEvent(QMouseEvent* event) {
  if (!panning_ && event->button() == Qt::LeftButton) session_.select(pick(event->position()));
  panning_ = false;
}

void PatternView::wheelEvent(QWheelEvent* event) {
  const QPointF before = toSheet(event->position());
  scale_ = std::clamp(scale_ * std::pow(1.2, event->angleDelta().y() / 120.0), 0.01, 20.0);
  centre_ += before - toSheet(event->position());
  fitted_ = false;
  Q_EMIT scaleChanged();
  update();
}

void PatternView::leaveEvent(QEvent*) {
  session_.setHover({});
}

}  // namespace toile::studio
