// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/viewport.h"

#include <Eigen/Geometry>
#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QPointer>
#include <QThreadPool>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/palette.h"
#include "viewport/overlay_painter.h"

namespace toile::studio {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kMenuTravel = 4;   // px a right press may move and still open the menu
constexpr int kFlight = 180;        // ms
constexpr int kRest = 160;          // ms after which the picture is drawn finely
constexpr double kWheelStep = 1.2;  // nearer by one notch
constexpr int kFineSamples = 4;

/// How far the body reaches around the middle of its box.
struct Ball {
  Vector3d centre{0, 0, 900};
  double radius = 1000;
};
Ball ballOf(const ReferenceModel& model) {
  const Vector3d& low = model.mesh->boxMin();
  const Vector3d& high = model.mesh->boxMax();
  return {0.5 * (low + high), 0.5 * (high - low).norm() + 20};
}

void applyDashes(DrawnLine& line, const LineLook& look) {
  if (look.dots) {
    line.gap = look.dashes[1];
    line.casing = 0;
    return;
  }
  if (look.dashes.size() >= 2) line.dash = look.dashes[0], line.gap = look.dashes[1];
  if (look.dashes.size() >= 4) line.dash2 = look.dashes[2], line.gap2 = look.dashes[3];
}

DrawnLine inkOf(CurveKind kind) {
  const LineLook look = lookOf(kind);
  DrawnLine line;
  line.colour = look.onBody;
  line.width = look.width;
  applyDashes(line, look);
  return line;
}

}  // namespace

Viewport::Viewport(Session& session, QWidget* parent) : QOpenGLWidget(parent), session_(session) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(360, 300);
  setAccessibleName(tr("Body"));
  setObjectName(QStringLiteral("viewport"));
  QSurfaceFormat wanted = format();
  wanted.setVersion(3, 3);
  wanted.setProfile(QSurfaceFormat::CoreProfile);
  wanted.setDepthBufferSize(24);
  wanted.setStencilBufferSize(8);
  setFormat(wanted);
  clock_.start();

  connect(&session, &Session::workStarted, this, &Viewport::bodyChanged);
  connect(&session, &Session::linesChanged, this, [this] { update(); });
  connect(&session, &Session::selectionChanged, this, [this] { update(); });
  connect(&session, &Session::hoverChanged, this, [this] { update(); });
  connect(&session, &Session::toolMoved, this, [this] {
    updateCursor();
    update();
  });
  connect(&session, &Session::patternChanged, this, [this] {
    if (session_.isPatternPreview()) return;
    verticesAreOld_ = true;
    update();
  });
  rest_.setSingleShot(true);
  rest_.setInterval(kRest);
  connect(&rest_, &QTimer::timeout, this, [this] {
    coarse_ = false;
    update();
  });
  flight_.setDuration(kFlight);
  flight_.setStartValue(0.0);
  flight_.setEndValue(1.0);
  flight_.setEasingCurve(QEasingCurve::OutCubic);
  connect(&flight_, &QVariantAnimation::valueChanged, this, [this](const QVariant& value) {
    setCamera(between(flightFrom_, flightTo_, value.toDouble()));
  });
  if (session.hasWork()) bodyChanged();
}

Viewport::~Viewport() {
  makeCurrent();
  fine_.reset();
  body_ = BodyLayer();
  lines_ = LineLayer();
  doneCurrent();
}

void Viewport::bodyChanged() {
  const auto model = session_.document().model;
  if (!shape_ || shape_->model != model) {
    shape_ = std::make_shared<BodyShape>(makeBodyShape(model));
    const std::uint64_t number = ++shapeNumber_;
    // Folds darken a moment later: what the eye needs first is there at once.
    QPointer<Viewport> self(this);
    QThreadPool::globalInstance()->start([self, shape = *shape_, number] {
      std::vector<float> openness = computeOpenness(shape);
      QMetaObject::invokeMethod(
          qApp,
          [self, openness = std::move(openness), number]() mutable {
            if (!self || self->shapeNumber_ != number) return;
            self->shape_->openness = std::move(openness);
            self->verticesAreOld_ = true;
            self->update();
          },
          Qt::QueuedConnection);
    });
    camera_ = fitted(seenFrom(Camera(), StandardView::Front), model->mesh->boxMin(),
                     model->mesh->boxMax(), double(width()) / std::max(1, height()));
    setCamera(camera_);
  }
  verticesAreOld_ = true;
  update();
}

Screen Viewport::screen() const {
  return {camera_.view(), double(std::max(1, width())), double(std::max(1, height()))};
}

void Viewport::setCamera(const Camera& camera) {
  camera_ = camera;
  session_.setScreen(screen());
  interacted();
  Q_EMIT cameraChanged();
}

void Viewport::interacted() {
  coarse_ = true;
  rest_.start();
  update();
}

void Viewport::lookFrom(const Camera& camera) {
  flight_.stop();
  if (!motion_) return setCamera(camera);
  flightFrom_ = camera_;
  flightTo_ = camera;
  flight_.start();
}

void Viewport::lookFrom(StandardView side) {
  lookFrom(seenFrom(camera_, side));
}

void Viewport::fitAll() {
  const Mesh& mesh = *session_.document().model->mesh;
  lookFrom(fitted(camera_, mesh.boxMin(), mesh.boxMax(), double(width()) / std::max(1, height())));
}

std::vector<Vector3d> Viewport::selectedPoints() const {
  const Selection& selection = session_.selection();
  if (selection.kind == Selection::Kind::Line) {
    const PlacedLine* line = session_.lines().find(selection.id);
    return line == nullptr ? std::vector<Vector3d>() : line->points;
  }
  if (selection.kind == Selection::Kind::Piece && session_.pattern()) {
    for (const Piece& piece : session_.pattern()->cut.pieces) {
      if (piece.id == selection.id) return piece.mesh->positions();
    }
  }
  return {};
}

void Viewport::fitSelection() {
  const std::vector<Vector3d> points = selectedPoints();
  if (points.empty()) return fitAll();
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  lookFrom(fitted(camera_, low, high, double(width()) / std::max(1, height())));
}

void Viewport::lookStraightAtSelection() {
  const Selection& selection = session_.selection();
  Vector3d normal = Vector3d::Zero();
  if (const PlacedLine* line = session_.lines().find(selection.id)) {
    for (const Vector3d& n : line->normals) normal += n;
  } else if (session_.pattern()) {
    for (const Piece& piece : session_.pattern()->cut.pieces) {
      if (piece.id != selection.id) continue;
      for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
        normal += piece.mesh->area(FaceId(f)) * piece.mesh->normal(FaceId(f));
      }
    }
  }
  const std::vector<Vector3d> points = selectedPoints();
  if (points.empty() || normal.norm() < 1e-9) return;
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  lookFrom(
      fitted(lookingAlong(camera_, normal), low, high, double(width()) / std::max(1, height())));
}

void Viewport::setColouring(BodyColouring colouring, StrainMeasure measure, double scale,
                            double limit) {
  colouring_ = colouring;
  measure_ = measure;
  look_.strainScale = scale;
  look_.strainLimit = limit;
  look_.strainOneSided = measure == StrainMeasure::Shear;
  verticesAreOld_ = true;
  update();
}

void Viewport::setEdges(bool edges) {
  look_.edges = edges;
  update();
}

void Viewport::setSeeThrough(bool seeThrough) {
  seeThrough_ = seeThrough;
  update();
}

void Viewport::themeChanged() {
  verticesAreOld_ = true;
  update();
}

QString Viewport::viewName() const {
  if (camera_.elevation > 1.2) return tr("from above");
  if (camera_.elevation < -1.2) return tr("from below");
  // Eight directions; the wearer's right is what is seen from azimuth -90 degrees.
  const double turns = camera_.azimuth / (std::numbers::pi / 4);
  switch ((static_cast<int>(std::lround(turns)) + 8) % 8) {
    case 0:
      return std::abs(turns) < 0.06 ? tr("front")
             : turns < 0            ? tr("front, from the right")
                                    : tr("front, from the left");
    case 1:
      return tr("front, from the left");
    case 2:
      return tr("left side");
    case 3:
      return tr("back, from the left");
    case 4:
      return tr("back");
    case 5:
      return tr("back, from the right");
    case 6:
      return tr("right side");
    default:
      return tr("front, from the right");
  }
}

// ---- drawing

void Viewport::initializeGL() {
  initializeOpenGLFunctions();
  body_.initialize();
  lines_.initialize();
  verticesAreOld_ = true;
}

void Viewport::resizeGL(int, int) {
  fine_.reset();
  session_.setScreen(screen());
}

void Viewport::updateVertices() {
  verticesAreOld_ = false;
  if (!shape_) return;
  body_.setVertices(makeBodyVertices(*shape_, session_.pattern().get(), colouring_, measure_));
}

std::vector<DrawnLine> Viewport::drawnLines(const Overlay& overlay) const {
  std::vector<DrawnLine> drawn;
  const Palette& colours = studio::palette();
  QColor halo("#1558D6"), hoverHalo = halo;
  halo.setAlphaF(0.5F);
  hoverHalo.setAlphaF(0.25F);

  for (const auto& line : session_.lines().all()) {
    DrawnLine ink = inkOf(line->curve.kind);
    ink.points = line->points;
    ink.normals = line->normals;
    const bool isDraft =
        session_.isPreview() && line->curve.mirrorOf && session_.selection().id != line->curve.id &&
        !std::ranges::any_of(session_.document().design->curves,
                             [&](const auto& c) { return c.id == line->curve.id; });
    if (isDraft) {  // the twin of a line at work
      ink.width = 1.8;
      ink.dash = 6, ink.gap = 4, ink.dash2 = ink.gap2 = 0;
    }
    if (session_.selection().isLine(line->curve.id)) {
      ink.halo = halo;
    } else if (session_.hover().isLine(line->curve.id)) {
      ink.halo = hoverHalo;
    }
    drawn.push_back(std::move(ink));
  }
  // The outline of the selected piece.
  if (session_.pattern() && !session_.isPreview()) {
    for (const Piece& piece : session_.pattern()->cut.pieces) {
      const bool isSelected = session_.selection().isPiece(piece.id);
      if (!isSelected && !session_.hover().isPiece(piece.id)) continue;
      for (const Wire& wire : piece.wires) {
        if (!isBoundary(wire.kind)) continue;
        DrawnLine outline;
        for (const VertexId v : wire.vertices) {
          outline.points.push_back(piece.mesh->position(v));
          Vector3d normal = Vector3d::Zero();
          for (const FaceId f : piece.mesh->facesAround(v)) normal += piece.mesh->normal(f);
          outline.normals.push_back(normal.normalized());
        }
        outline.width = 0;
        outline.casing = 0;
        outline.halo = isSelected ? halo : hoverHalo;
        drawn.push_back(std::move(outline));
      }
    }
  }
  if (overlay.showMiddle) {
    for (const auto& middle : session_.middle()) {
      DrawnLine line;
      line.points = middle;
      line.colour = QColor("#5A2CB0");
      line.width = 1.3;
      line.casing = 0;
      line.dash = 9, line.gap = 4, line.dash2 = 1.5, line.gap2 = 4;
      drawn.push_back(std::move(line));
    }
  }
  for (const OverlayLine& line : overlay.lines) {
    DrawnLine ink = inkOf(line.kind);
    ink.points = line.points;
    ink.normals = line.normals;
    switch (line.style) {
      case OverlayLine::Style::Draft:
        break;
      case OverlayLine::Style::Twin:
        ink.width = 1.8;
        ink.dash = 6, ink.gap = 4;
        break;
      case OverlayLine::Style::Before:
        ink.width = 1.4;
        ink.colour = QColor("#55585E");
        ink.dash = 2, ink.gap = 3, ink.dash2 = ink.gap2 = 0;
        ink.casing = 0.3;
        break;
      case OverlayLine::Style::Remove:
        ink.halo = colours.trouble;
        ink.halo.setAlphaF(0.55F);
        break;
    }
    drawn.push_back(std::move(ink));
  }
  return drawn;
}

void Viewport::drawScene(const Overlay& overlay) {
  const Screen shown = screen();
  const Ball ball = ballOf(*session_.document().model);
  const Eigen::Matrix4d clip = shown.clipFromWorld(ball.centre, ball.radius);
  Screen pixels = shown;
  pixels.width *= devicePixelRatioF();
  pixels.height *= devicePixelRatioF();
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  body_.drawGround(*this);
  BodyLook look = look_;
  if (overlay.seeThroughTo) look.seeThrough = SeeThrough{*overlay.seeThroughTo};
  body_.draw(*this, pixels, clip, look);
  lines_.draw(*this, shown, clip, devicePixelRatioF(), drawnLines(overlay), seeThrough_);
}

void Viewport::paintGL() {
  if (verticesAreOld_) updateVertices();
  const Overlay overlay = session_.hasWork() ? session_.tool().overlay(session_) : Overlay();
  if (session_.hasWork()) {
    const QSize size = this->size() * devicePixelRatioF();
    if (coarse_) {
      drawScene(overlay);
    } else {
      if (!fine_ || fine_->size() != size) {
        QOpenGLFramebufferObjectFormat format;
        format.setSamples(kFineSamples);
        format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
        fine_ = std::make_unique<QOpenGLFramebufferObject>(size, format);
      }
      fine_->bind();
      glViewport(0, 0, size.width(), size.height());
      drawScene(overlay);
      glBindFramebuffer(GL_READ_FRAMEBUFFER, fine_->handle());
      glBindFramebuffer(GL_DRAW_FRAMEBUFFER, defaultFramebufferObject());
      glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                        GL_COLOR_BUFFER_BIT, GL_NEAREST);
      glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
    }
    paintOverlay(overlay);
  }
  Q_EMIT painted();
}

void Viewport::paintOverlay(const Overlay& overlay) {
  glDisable(GL_DEPTH_TEST);
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const std::optional<Vector2d> cursor =
      lastPointer_ ? std::optional(lastPointer_->at) : std::nullopt;
  paintToolOverlay(painter, overlay, session_, cursor);
}

// ---- hands

PointerEvent Viewport::pointer(const QPointF& place, Qt::KeyboardModifiers modifiers) const {
  PointerEvent event;
  event.at = {place.x(), place.y()};
  event.ctrl = modifiers.testFlag(Qt::ControlModifier);
  event.shift = modifiers.testFlag(Qt::ShiftModifier);
  event.seconds = static_cast<double>(clock_.nsecsElapsed()) * 1e-9;
  return event;
}

void Viewport::pressed(Qt::MouseButton button, const PointerEvent& event,
                       Qt::KeyboardModifiers modifiers) {
  if (button_ != Qt::NoButton || !session_.hasWork()) return;  // a second button changes nothing
  setFocus(Qt::MouseFocusReason);
  flight_.stop();
  session_.setScreen(screen());
  button_ = button;
  pressedAt_ = lastAt_ = event.at;
  travelled_ = 0;
  const bool onGround = button == Qt::LeftButton && !session_.tool().takesPress(event, session_);
  gesture_ = gestureOf(navigation_, button, modifiers, space_, onGround);
  toolHasPress_ = gesture_ == ViewGesture::None && button == Qt::LeftButton;
  if (toolHasPress_) session_.pointer(PointerAction::Press, event);
  lastPointer_ = event;
}

void Viewport::moved(const PointerEvent& event) {
  if (!session_.hasWork()) return;
  const Vector2d step = event.at - lastAt_;
  lastAt_ = event.at;
  lastPointer_ = event;
  travelled_ = std::max(travelled_, (event.at - pressedAt_).norm());
  switch (gesture_) {
    case ViewGesture::Turn:
      return setCamera(turned(camera_, step, screen()));
    case ViewGesture::Pan:
      return setCamera(panned(camera_, step, screen()));
    case ViewGesture::Zoom:
      return setCamera(zoomed(camera_, std::exp(-0.006 * step.y()), pressedAt_, screen()));
    case ViewGesture::None:
      break;
  }
  if (button_ != Qt::NoButton && !toolHasPress_) return;
  if (toolHasPress_) {
    coarse_ = true;
    rest_.start();
  }
  session_.pointer(PointerAction::Move, event);
}

void Viewport::released(const PointerEvent& event, const QPoint& globalPlace) {
  const ViewGesture gesture = std::exchange(gesture_, ViewGesture::None);
  const Qt::MouseButton button = std::exchange(button_, Qt::NoButton);
  const bool toolHad = std::exchange(toolHasPress_, false);
  lastPointer_ = event;
  if (toolHad) {
    session_.pointer(PointerAction::Release, event);
  } else if (button == Qt::RightButton && travelled_ < kMenuTravel) {
    Q_EMIT contextMenuWanted(globalPlace);
  } else if (button == Qt::LeftButton && gesture == ViewGesture::Turn && travelled_ < kMenuTravel &&
             session_.tool().id() == ToolId::Select) {
    session_.select({});
  }
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  pressed(event->button(), pointer(event->position(), event->modifiers()), event->modifiers());
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  moved(pointer(event->position(), event->modifiers()));
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != button_) return;
  released(pointer(event->position(), event->modifiers()), event->globalPosition().toPoint());
}

void Viewport::mouseDoubleClickEvent(QMouseEvent* event) {
  const PointerEvent at = pointer(event->position(), event->modifiers());
  if (event->button() == Qt::LeftButton && session_.hasWork() &&
      session_.tool().takesPress(at, session_)) {
    session_.pointer(PointerAction::DoubleClick, at);
  } else {
    mousePressEvent(event);
  }
}

void Viewport::tabletEvent(QTabletEvent* event) {
  PointerEvent at = pointer(event->position(), event->modifiers());
  at.pen = true;
  at.pressure = event->pressure();
  switch (event->type()) {
    case QEvent::TabletPress:
      pressed(event->button(), at, event->modifiers());
      break;
    case QEvent::TabletMove:
      moved(at);
      break;
    case QEvent::TabletRelease:
      released(at, event->globalPosition().toPoint());
      break;
    default:
      break;
  }
  event->accept();
}

void Viewport::wheelEvent(QWheelEvent* event) {
  flight_.stop();
  const QPointF turned_ = event->pixelDelta().isNull() ? QPointF(event->angleDelta()) / 2.0
                                                       : QPointF(event->pixelDelta());
  const Vector2d drag(turned_.x(), turned_.y());
  const Vector2d at(event->position().x(), event->position().y());
  switch (wheelGestureOf(navigation_, event->modifiers())) {
    case ViewGesture::Turn:
      setCamera(turned(camera_, drag, screen()));
      break;
    case ViewGesture::Pan:
      setCamera(panned(camera_, drag, screen()));
      break;
    default: {
      const double notches = (event->angleDelta().y() + event->angleDelta().x()) / 120.0;
      setCamera(zoomed(camera_, std::pow(kWheelStep, notches), at, screen()));
    }
  }
  event->accept();
}

void Viewport::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space) {
    space_ = true;
    return;
  }
  std::optional<ToolKey> key;
  switch (event->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
      key = ToolKey::Enter;
      break;
    case Qt::Key_Escape:
      key = ToolKey::Escape;
      break;
    case Qt::Key_Backspace:
      key = ToolKey::Backspace;
      break;
    case Qt::Key_Delete:
      key = ToolKey::Delete;
      break;
    case Qt::Key_Tab:
      key = ToolKey::Next;
      break;
    case Qt::Key_Backtab:
      key = ToolKey::Previous;
      break;
    case Qt::Key_Left:
      key = ToolKey::Left;
      break;
    case Qt::Key_Right:
      key = ToolKey::Right;
      break;
    case Qt::Key_Up:
      key = ToolKey::Up;
      break;
    case Qt::Key_Down:
      key = ToolKey::Down;
      break;
    default:
      break;
  }
  if (!key || !session_.hasWork()) return QOpenGLWidget::keyPressEvent(event);
  if (session_.key(*key)) return;
  if (*key == ToolKey::Escape && session_.tool().id() != ToolId::Select) {
    session_.setTool(ToolId::Select);
  } else if (*key == ToolKey::Next || *key == ToolKey::Previous) {
    QOpenGLWidget::focusNextPrevChild(*key == ToolKey::Next);
  } else {
    QOpenGLWidget::keyPressEvent(event);
  }
}

void Viewport::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) space_ = false;
  QOpenGLWidget::keyReleaseEvent(event);
}

bool Viewport::focusNextPrevChild(bool) {
  return false;  // Tab is a key of tools; keyPressEvent() passes it on when no tool wants it
}

void Viewport::leaveEvent(QEvent*) {
  lastPointer_.reset();
  session_.setHover({});
  update();
}

void Viewport::updateCursor() {
  if (gesture_ != ViewGesture::None) return;
  switch (session_.tool().cursor()) {
    case CursorShape::Arrow:
      setCursor(Qt::ArrowCursor);
      break;
    case CursorShape::OpenHand:
      setCursor(Qt::OpenHandCursor);
      break;
    case CursorShape::ClosedHand:
      setCursor(Qt::ClosedHandCursor);
      break;
    case CursorShape::Pencil:
    case CursorShape::Cross:
    case CursorShape::CrossRing:
      setCursor(Qt::CrossCursor);
      break;
  }
}

}  // namespace toile::studio
