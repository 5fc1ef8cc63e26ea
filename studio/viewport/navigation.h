// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <Qt>

namespace toile::studio {

/// Whose mouse habits the view follows.
enum class NavigationPreset { Toile, Blender, Rhino, Maya, Trackpad };
inline constexpr int kNavigationPresetCount = 5;
[[nodiscard]] QString nameOf(NavigationPreset preset);

enum class ViewGesture { None, Turn, Pan, Zoom };

/// What a press begins. None: it is the tool's (left button) or may open the menu (right).
/// @param onGround nothing that the tool takes is below the pointer
[[nodiscard]] ViewGesture gestureOf(NavigationPreset preset, Qt::MouseButton button,
                                    Qt::KeyboardModifiers modifiers, bool space, bool onGround);
/// What turning the wheel, or two fingers on a trackpad, does.
[[nodiscard]] ViewGesture wheelGestureOf(NavigationPreset preset, Qt::KeyboardModifiers modifiers);

}  // namespace toile::studio
