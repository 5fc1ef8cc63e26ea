// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/navigation.h"

#include <QCoreApplication>

namespace toile::studio {

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(Navigation)
};

}  // namespace

QString nameOf(NavigationPreset preset) {
  switch (preset) {
    case NavigationPreset::Toile:
      return QStringLiteral("Toile");
    case NavigationPreset::Blender:
      return Words::tr("Like Blender");
    case NavigationPreset::Rhino:
      return Words::tr("Like Rhino");
    case NavigationPreset::Maya:
      return Words::tr("Like Maya");
    case NavigationPreset::Trackpad:
      return Words::tr("Trackpad");
  }
  return {};
}

ViewGesture gestureOf(NavigationPreset preset, Qt::MouseButton button,
                      Qt::KeyboardModifiers modifiers, bool space, bool onGround) {
  const bool shift = modifiers.testFlag(Qt::ShiftModifier);
  const bool ctrl = modifiers.testFlag(Qt::ControlModifier);
  const bool held = space || modifiers.testFlag(Qt::AltModifier);
  // Space or Alt with any button, in every preset: the way of those with a pen and one button.
  if (held && button == Qt::LeftButton) {
    return shift ? ViewGesture::Pan : ctrl ? ViewGesture::Zoom : ViewGesture::Turn;
  }
  if (button == Qt::LeftButton) {
    if (!onGround) return ViewGesture::None;
    return shift ? ViewGesture::Pan : ViewGesture::Turn;
  }
  if (preset == NavigationPreset::Maya) {
    if (button == Qt::MiddleButton) return ViewGesture::Pan;
    return held ? ViewGesture::Zoom : ViewGesture::Turn;
  }
  const bool blenderMiddle = preset == NavigationPreset::Blender && button == Qt::MiddleButton;
  if (button == Qt::MiddleButton && !blenderMiddle) return ViewGesture::Pan;
  if (shift) return ViewGesture::Pan;
  return ctrl ? ViewGesture::Zoom : ViewGesture::Turn;
}

ViewGesture wheelGestureOf(NavigationPreset preset, Qt::KeyboardModifiers modifiers) {
  if (preset != NavigationPreset::Trackpad) return ViewGesture::Zoom;
  if (modifiers.testFlag(Qt::ControlModifier)) return ViewGesture::Zoom;
  return modifiers.testFlag(Qt::ShiftModifier) ? ViewGesture::Pan : ViewGesture::Turn;
}

}  // namespace toile::studio
