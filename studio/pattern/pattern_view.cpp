// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/pattern_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/palette.h"
#include "document/sheet_edits.h"
#include "viewport/body_vertices.h"
#include "viewport/overlay_painter.h"

namespace toile::studio {

namespace {

constexpr double kLineCatch = 8;    // px
constexpr double kHandleCatch = 9;  // px
constexpr double kClick = 4;        // px that a click may move
constexpr double kTurnSnap = 2;     // degrees to a multiple of kTurnStep
constexpr double kTurnStep = 15;

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

bool isNear(const QPointF& a, const QPointF& b, double within) {
  return std::hypot(a.x() - b.x(), a.y() - b.y()) <= within;
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
  connect(&session, &Session::ghostsChanged, this, [this] { update(); });
  connect(&session, &Session::coloursChanged, this, &PatternView::takePattern);
  connect(&session, &Session::strainChanged, this, [this] {
    colour();
    update();
  });
  connect(&session, &Session::toolChanged, this, [this] {
    measured_.clear();
    setCursor(session_.tool().id() == ToolId::Measure ? Qt::CrossCursor : Qt::ArrowCursor);
    update();
  });
}

void PatternView::setShown(const PatternShown& shown) {
  shown_ = shown;
  update();
}

QRect PatternView::pixelsOfPreview() const {
  QRectF box;
  for (const DrawnPiece& piece : pieces_) {
    if (piece.isPreview) box = box.united(view_.transform().mapRect(piece.cut.boundingRect()));
  }
  return box.isEmpty() ? QRect() : box.toAlignedRect().adjusted(-14, -14, 14, 14);
}

void PatternView::takePattern() {
  const QRect before = pixelsOfPreview();
  const bool isPreview = session_.isPatternPreview();
  pieces_.clear();
  box_ = {};
  if (const auto pattern = session_.pattern()) {
    pieces_ = drawPattern(*pattern, session_.pieceColours(), isPreview ? &full_ : nullptr);
    for (const DrawnPiece& piece : pieces_) box_ = box_.united(piece.cut.boundingRect());
    // The sheet begins where its first piece lies; what is shown stays in its place.
    Eigen::Vector2d moved = Eigen::Vector2d::Zero();
    if (!pattern->layout.side.empty()) {  // not of a preview, which keeps the places
      moved = pattern->layout.mapOrigin[0] - origin_;
      origin_ = pattern->layout.mapOrigin[0];
    }
    if (!fitted_) view_.centre += QPointF(moved.x(), moved.y());
    if (const DrawnPiece* piece = find(putDown_)) {
      fitted_ = false;
      view_.centre += piece->middle - view_.toSheet(putDownAt_);
      if (!session_.isPatternPreview()) putDown_.clear();
    }
  }
  if (!isPreview) {
    colour();
    full_ = pieces_;
  }
  if (fitted_ && !isPreview) fitAll();
  // A preview at once: an update waits for its turn as long as the mouse keeps moving.
  if (isPreview && isVisible()) {
    const bool isFirst = before.isEmpty();
    return repaint(isFirst ? rect() : before.united(pixelsOfPreview()));
  }
  update();
}

void PatternView::colour() {
  const StrainLook& look = session_.strainLook();
  for (DrawnPiece& piece : pieces_) piece.strain = {};
  const auto& pattern = session_.pattern();
  if (!look.on || !pattern || session_.isPatternPreview() || !session_.strains()) return;
  for (DrawnPiece& piece : pieces_) {
    const auto& strain = (*session_.strains())[piece.cutIndex];
    if (!strain) continue;
    const Mesh& mesh = *pattern->cut.pieces[piece.cutIndex].mesh;
    paintStrain(piece, *pattern, strainOfVertices(mesh, *strain, look.kind), look.scale,
                look.kind == StrainKind::Shear);
  }
}

const DrawnPiece* PatternView::find(const std::string& id) const {
  const auto found = std::ranges::find(pieces_, id, &DrawnPiece::id);
  return found == pieces_.end() ? nullptr : &*found;
}

void PatternView::fitAll() {
  fitted_ = true;
  view_.size = size();
  if (box_.isEmpty() || width() < 2 * kRuler) return;
  const double room = 28;
  view_.scale = std::min((width() - kRuler - 2 * room) / box_.width(),
                         (height() - kRuler - 2 * room) / box_.height());
  view_.scale = std::clamp(view_.scale, 0.01, 5.0);
  view_.centre = box_.center() - QPointF(kRuler / 2, -kRuler / 2) / view_.scale;
  Q_EMIT scaleChanged();
  update();
}

void PatternView::resizeEvent(QResizeEvent*) {
  view_.size = size();
  if (fitted_) fitAll();
}

void PatternView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  PatternPainter pattern(painter, view_, session_, shown_);
  const bool isPreview = session_.isPatternPreview() && gesture_ == Gesture::None;
  if (isPreview) {
    paintStill();
    painter.drawPixmap(0, 0, still_);
  } else {
    stillOf_.reset();
    pattern.paintGround();
  }
  const DrawnPiece* held = gesture_ == Gesture::None ? nullptr : find(held_);
  for (const DrawnPiece& piece : pieces_) {
    if (&piece != held && (!isPreview || piece.isPreview)) pattern.paintPiece(piece);
  }
  const bool isCarried = gesture_ == Gesture::Move || gesture_ == Gesture::Turn;
  if (held != nullptr) {
    if (isCarried) {
      pattern.paintPiece(*held, motion());
    } else {
      DrawnPiece turned = *held;
      if (gesture_ == Gesture::Grain) turned.grain = motion().map(held->grain);
      pattern.paintPiece(turned);
    }
  }
  if (session_.hasWork() && session_.pattern()) {
    const Selection& selection = session_.selection();
    if (selection.kind == Selection::Kind::Line && !isCarried) {
      pattern.paintMates(matesOf(pieces_, *session_.pattern(), selection.id));
    }
    const DrawnPiece* selected =
        selection.kind == Selection::Kind::Piece ? find(selection.id) : nullptr;
    if (selected != nullptr && gesture_ != Gesture::Grain) {
      pattern.paintHandles(*selected, selected == held && isCarried ? motion() : QTransform());
    }
    pattern.paintSpots(pieces_);
    pattern.paintGhosts(pieces_);
    if (gesture_ == Gesture::Turn || gesture_ == Gesture::Grain) {
      paintReadOut(painter,
                   {{gesture_ == Gesture::Turn ? tr("turned") : tr("grain turned"),
                     QStringLiteral("%1°").arg(turnOfHand(), 0, 'f', 1)}},
                   lastAt_);
    }
  }
  paintMeasure(painter);
  if (pieces_.empty() && session_.hasWork()) {
    painter.setPen(studio::palette().second);
    const bool isCut = session_.pattern() && session_.pattern()->cut.pieces.size() > 1;
    const QString text =
        session_.document().design->curves.empty()
            ? tr("Nothing drawn yet. Take the pencil (P) and draw a line on the body.")
        : isCut ? tr("No piece can lie flat yet. Findings says why, and what helps.")
                : tr("No piece is closed yet. Lines that run from edge to edge cut a piece.");
    painter.drawText(rect().adjusted(60, 0, -40, 0), Qt::AlignCenter | Qt::TextWordWrap, text);
  }
  pattern.paintRulers();
}

void PatternView::paintStill() {
  Still wanted{view_, shown_, session_.selection(), session_.hover(), studio::palette().sheet.rgb(),
               {}};
  for (const DrawnPiece& piece : pieces_) {
    if (!piece.isPreview) wanted.pieces.push_back(piece.id);
  }
  if (stillOf_ == wanted) return;
  stillOf_ = wanted;
  const QSize size = (QSizeF(this->size()) * devicePixelRatioF()).toSize();
  if (still_.size() != size) still_ = QPixmap(size);
  still_.setDevicePixelRatio(devicePixelRatioF());
  QPainter painter(&still_);
  painter.setFont(font());
  painter.setRenderHint(QPainter::Antialiasing);
  PatternPainter pattern(painter, view_, session_, shown_);
  pattern.paintGround();
  for (const DrawnPiece& piece : pieces_) {
    if (!piece.isPreview) pattern.paintPiece(piece);
  }
}

Selection PatternView::pick(const QPointF& pixel) const {
  const QPointF at = view_.toSheet(pixel);
  Selection best;
  double nearest = kLineCatch / view_.scale;
  for (const DrawnPiece& piece : pieces_) {
    for (const auto* runs : {&piece.runs, &piece.inner}) {
      for (const DrawnRun& run : *runs) {
        const double distance = distanceTo(run.points, at);
        if (distance >= nearest) continue;
        nearest = distance;
        best = Selection::line(run.curve);
        best.onPiece = piece.id;
      }
    }
  }
  if (best.kind != Selection::Kind::None && session_.lines().find(best.id) != nullptr) return best;
  for (const DrawnPiece& piece : pieces_) {
    if (piece.cut.contains(at)) return Selection::piece(piece.id);
  }
  return {};
}

// ---- hands

PatternView::Gesture PatternView::gestureAt(const QPointF& pixel, const DrawnPiece** piece) const {
  *piece = nullptr;
  if (session_.tool().id() == ToolId::Measure || !session_.isPatternCurrent()) return Gesture::Pan;
  const Selection& selection = session_.selection();
  if (const DrawnPiece* selected =
          selection.kind == Selection::Kind::Piece ? find(selection.id) : nullptr) {
    *piece = selected;
    if (isNear(pixel, turnHandle(*selected, view_), kHandleCatch)) return Gesture::Turn;
    for (const QPointF& end : {selected->grain.p1(), selected->grain.p2()}) {
      if (shown_.grain && isNear(pixel, view_.toPixel(end), kHandleCatch)) return Gesture::Grain;
    }
  }
  // A piece is held anywhere, by its lines too.
  const auto below = std::ranges::find_if(
      pieces_, [at = view_.toSheet(pixel)](const auto& each) { return each.cut.contains(at); });
  *piece = below == pieces_.end() ? nullptr : &*below;
  return *piece == nullptr ? Gesture::Pan : Gesture::Move;
}

double PatternView::turnOfHand() const {
  const DrawnPiece* piece = find(held_);
  if (piece == nullptr) return 0;
  const QPointF middle =
      view_.toPixel(gesture_ == Gesture::Grain ? piece->grain.center() : piece->middle);
  const double turn = QLineF(middle, pressedAt_).angleTo(QLineF(middle, lastAt_));
  const double degrees = std::remainder(turn, 360.0);
  const double near = std::round(degrees / kTurnStep) * kTurnStep;
  return std::abs(degrees - near) < kTurnSnap ? near : degrees;
}

QTransform PatternView::motion() const {
  const DrawnPiece* piece = find(held_);
  QTransform motion;
  if (piece == nullptr || !moved_) return motion;
  if (gesture_ == Gesture::Move) {
    const QPointF step = view_.toSheet(lastAt_) - view_.toSheet(pressedAt_);
    motion.translate(step.x(), step.y());
    return motion;
  }
  const QPointF middle = gesture_ == Gesture::Grain ? piece->grain.center() : piece->middle;
  motion.translate(middle.x(), middle.y());
  motion.rotate(turnOfHand());
  motion.translate(-middle.x(), -middle.y());
  return motion;
}

void PatternView::finishGesture() {
  const DrawnPiece* piece = find(held_);
  const auto& pattern = session_.fullPattern();
  if (piece == nullptr || !pattern || !session_.isPatternCurrent()) return;
  const QString name = piece->name;
  if (gesture_ == Gesture::Grain) {
    const auto made =
        withGrainTurned(session_.document(), *pattern, piece->id, Angle::degrees(turnOfHand()));
    if (made) session_.commit(tr("Grain of %1").arg(name), *made);
    return;
  }
  const QTransform hand = motion();
  const double turn = gesture_ == Gesture::Turn ? turnOfHand() : 0;
  Placement wanted = piece->placement;
  wanted.angle += turn * std::numbers::pi / 180;
  const QPointF offset = hand.map(toQt(piece->placement.offset));
  wanted.offset = {offset.x(), offset.y()};
  putDown_ = piece->id;
  putDownAt_ = view_.toPixel(hand.map(piece->middle));
  const std::string id = piece->id;
  const auto made = withPieceOnSheet(session_.document(), *pattern, piece->index, wanted);
  if (!made) return;
  const bool isNew = recordOf(*session_.document().design, id) == nullptr;
  if (isNew) putDown_ = made->design->layout.back().piece;
  session_.commit(
      (gesture_ == Gesture::Turn ? tr("Turn %1 on the sheet") : tr("Move %1 on the sheet"))
          .arg(name),
      *made);
  session_.select(Selection::piece(putDown_));
}

void PatternView::mousePressEvent(QMouseEvent* event) {
  pressedAt_ = lastAt_ = event->position();
  moved_ = false;
  const DrawnPiece* piece = nullptr;
  gesture_ =
      event->button() == Qt::LeftButton ? gestureAt(event->position(), &piece) : Gesture::Pan;
  held_ = piece == nullptr ? std::string() : piece->id;
}

void PatternView::mouseMoveEvent(QMouseEvent* event) {
  measureAt_ = event->position();
  if (event->buttons() == Qt::NoButton) {
    if (session_.tool().id() == ToolId::Measure) update();
    return session_.setHover(pick(event->position()));
  }
  if ((event->position() - pressedAt_).manhattanLength() > kClick) moved_ = true;
  const QPointF step = event->position() - lastAt_;
  lastAt_ = event->position();
  if (!moved_) return;
  if (gesture_ == Gesture::Pan) {
    view_.centre -= QPointF(step.x(), -step.y()) / view_.scale;
    fitted_ = false;
  }
  update();
}

void PatternView::mouseReleaseEvent(QMouseEvent* event) {
  lastAt_ = event->position();
  if (moved_ && gesture_ != Gesture::Pan) {
    finishGesture();
  } else if (!moved_ && event->button() == Qt::LeftButton) {
    if (session_.tool().id() == ToolId::Measure) {
      if (measured_.size() == 2) measured_.clear();
      measured_.push_back(caught(event->position()));
    } else {
      session_.select(pick(event->position()));
    }
  }
  gesture_ = Gesture::None;
  held_.clear();
  moved_ = false;
  update();
}

void PatternView::wheelEvent(QWheelEvent* event) {
  const QPointF before = view_.toSheet(event->position());
  view_.scale =
      std::clamp(view_.scale * std::pow(1.2, event->angleDelta().y() / 120.0), 0.01, 20.0);
  view_.centre += before - view_.toSheet(event->position());
  fitted_ = false;
  Q_EMIT scaleChanged();
  update();
}

void PatternView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    if (gesture_ != Gesture::None) {
      gesture_ = Gesture::None;
    } else if (!measured_.empty()) {
      measured_.clear();
    } else if (session_.tool().id() != ToolId::Select) {
      session_.setTool(ToolId::Select);
    } else {
      session_.select({});
    }
    return update();
  }
  QWidget::keyPressEvent(event);
}

void PatternView::leaveEvent(QEvent*) {
  session_.setHover({});
}

// ---- measuring

QPointF PatternView::caught(const QPointF& pixel) const {
  QPointF best = view_.toSheet(pixel);
  double nearest = kLineCatch;
  const auto offer = [&](const QPointF& place) {
    const QPointF off = view_.toPixel(place) - pixel;
    const double distance = std::hypot(off.x(), off.y());
    if (distance >= nearest) return;
    nearest = distance;
    best = place;
  };
  for (const DrawnPiece& piece : pieces_) {
    for (const DrawnRun& run : piece.runs) {
      if (run.points.isEmpty()) continue;
      offer(run.points.first());
      offer(run.points.last());
    }
    for (const QLineF& notch : piece.notches) offer(notch.p1());
  }
  return best;
}

void PatternView::paintMeasure(QPainter& painter) const {
  if (session_.tool().id() != ToolId::Measure) return;
  const QColor blue = studio::palette().selection;
  painter.setBrush(Qt::white);
  const auto mark = [&](const QPointF& place) {
    painter.setPen(QPen(blue, 2));
    painter.drawRect(QRectF(view_.toPixel(place) - QPointF(4, 4), QSizeF(8, 8)));
  };
  if (measured_.empty()) {
    if (!underMouse()) return;
    mark(caught(measureAt_));
    const Selection below = pick(measureAt_);
    for (const DrawnPiece& piece : pieces_) {
      if (piece.id != below.onPiece) continue;
      double length = 0;
      for (const auto* runs : {&piece.runs, &piece.inner}) {
        for (const DrawnRun& run : *runs) length += run.curve == below.id ? run.length : 0;
      }
      paintReadOut(painter, {{piece.name, session_.lengthText(length)}}, measureAt_);
    }
    return;
  }
  const QPointF from = measured_.front();
  const QPointF to = measured_.size() == 2 ? measured_.back() : caught(measureAt_);
  painter.setPen(QPen(blue, 1.6));
  painter.drawLine(view_.toPixel(from), view_.toPixel(to));
  mark(from);
  mark(to);
  const QPointF way = to - from;
  paintReadOut(painter,
               {{tr("straight"), session_.lengthText(std::hypot(way.x(), way.y()))},
                {tr("across"), session_.lengthText(std::abs(way.x()))},
                {tr("up"), session_.lengthText(std::abs(way.y()))}},
               view_.toPixel(to));
}

}  // namespace toile::studio
