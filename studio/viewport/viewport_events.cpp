// SPDX-License-Identifier: GPL-3.0-or-later
// The hands on the viewport: mouse, pen, wheel and keys become gestures of the view or events of
// the tool.
#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "viewport/viewport.h"

namespace toile::studio {

using Eigen::Vector2d;

namespace {

constexpr double kMenuTravel = 4;   // px a right press may move and still open the menu
constexpr double kWheelStep = 1.2;  // nearer by one notch

}  // namespace

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
  inHand_ = toolHasPress_;
  session_.pointer(PointerAction::Move, event);
  inHand_ = false;
  if (!toolHasPress_) return;
  // At once: an update waits for its turn as long as the mouse keeps moving.
  if (session_.isPreview()) {
    repaint(changedPixels());
  } else {
    update();
  }
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
  if (!key || !session_.hasWork()) return GlCanvas::keyPressEvent(event);
  if (session_.key(*key)) return;
  if (*key == ToolKey::Escape && session_.tool().id() != ToolId::Select) {
    session_.setTool(ToolId::Select);
  } else if (*key == ToolKey::Next || *key == ToolKey::Previous) {
    GlCanvas::focusNextPrevChild(*key == ToolKey::Next);
  } else {
    GlCanvas::keyPressEvent(event);
  }
}

void Viewport::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) space_ = false;
  GlCanvas::keyReleaseEvent(event);
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
