// SPDX-License-Identifier: GPL-3.0-or-later
// Looking at the body: what buttons and wheel begin in each preset, and what the camera does.
#include "viewport/navigation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <set>
#include <vector>

#include "desk.h"
#include "viewport/camera.h"

namespace toile::studio {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr auto kNone = Qt::NoModifier;
constexpr auto kShift = Qt::ShiftModifier;
constexpr auto kCtrl = Qt::ControlModifier;
constexpr auto kAlt = Qt::AltModifier;

std::vector<NavigationPreset> allPresets() {
  std::vector<NavigationPreset> all;
  for (int i = 0; i < kNavigationPresetCount; ++i) all.push_back(static_cast<NavigationPreset>(i));
  return all;
}

const std::vector<Qt::KeyboardModifiers>& allModifiers() {
  static const std::vector<Qt::KeyboardModifiers> all = {
      kNone,          kShift,        kCtrl,        kAlt,
      kShift | kCtrl, kShift | kAlt, kCtrl | kAlt, kShift | kCtrl | kAlt};
  return all;
}

/// Everything that a hand with these buttons can do where a tool wants the press for itself.
std::set<ViewGesture> within(NavigationPreset preset,
                             std::initializer_list<Qt::MouseButton> buttons, bool space) {
  std::set<ViewGesture> all;
  for (const Qt::MouseButton button : buttons) {
    for (const auto modifiers : allModifiers()) {
      all.insert(gestureOf(preset, button, modifiers, space, false));
    }
  }
  all.erase(ViewGesture::None);
  return all;
}

const std::set<ViewGesture> kAll = {ViewGesture::Turn, ViewGesture::Pan, ViewGesture::Zoom};

TEST(Navigation, EveryPresetTurnsPansAndZoomsWithTwoButtonsAndAWheel) {
  for (const NavigationPreset preset : allPresets()) {
    auto reached = within(preset, {Qt::LeftButton, Qt::RightButton}, false);
    EXPECT_EQ(reached, kAll) << nameOf(preset).toStdString();
    std::set<ViewGesture> wheel;
    for (const auto modifiers : allModifiers()) wheel.insert(wheelGestureOf(preset, modifiers));
    EXPECT_TRUE(wheel.contains(ViewGesture::Zoom)) << nameOf(preset).toStdString();
  }
}

TEST(Navigation, EveryPresetIsUsableWithAPen) {
  for (const NavigationPreset preset : allPresets()) {
    // One button: with Space held, and with Alt.
    EXPECT_EQ(within(preset, {Qt::LeftButton}, true), kAll) << nameOf(preset).toStdString();
    EXPECT_EQ(within(preset, {Qt::LeftButton}, false), kAll) << nameOf(preset).toStdString();
  }
}

TEST(Navigation, ALeftPressOnTheWorkIsTheTools) {
  for (const NavigationPreset preset : allPresets()) {
    for (const auto modifiers : {Qt::KeyboardModifiers(kNone), Qt::KeyboardModifiers(kShift),
                                 Qt::KeyboardModifiers(kCtrl)}) {
      EXPECT_EQ(gestureOf(preset, Qt::LeftButton, modifiers, false, false), ViewGesture::None);
    }
    EXPECT_EQ(gestureOf(preset, Qt::LeftButton, kNone, false, true), ViewGesture::Turn)
        << "beside it the body turns";
    EXPECT_EQ(gestureOf(preset, Qt::LeftButton, kShift, false, true), ViewGesture::Pan);
  }
}

TEST(Navigation, PresetsKeepTheHabitsTheyAreNamedFor) {
  using enum NavigationPreset;
  using enum ViewGesture;
  const auto press = [](NavigationPreset preset, Qt::MouseButton button,
                        Qt::KeyboardModifiers modifiers) {
    return gestureOf(preset, button, modifiers, false, false);
  };
  EXPECT_EQ(press(Blender, Qt::MiddleButton, kNone), Turn);
  EXPECT_EQ(press(Blender, Qt::MiddleButton, kShift), Pan);
  EXPECT_EQ(press(Blender, Qt::MiddleButton, kCtrl), Zoom);
  EXPECT_EQ(press(Rhino, Qt::RightButton, kNone), Turn);
  EXPECT_EQ(press(Rhino, Qt::RightButton, kShift), Pan);
  EXPECT_EQ(press(Rhino, Qt::RightButton, kCtrl), Zoom);
  EXPECT_EQ(press(Maya, Qt::LeftButton, kAlt), Turn);
  EXPECT_EQ(press(Maya, Qt::MiddleButton, kAlt), Pan);
  EXPECT_EQ(press(Maya, Qt::RightButton, kAlt), Zoom);
  EXPECT_EQ(press(Toile, Qt::RightButton, kNone), Turn);
  EXPECT_EQ(press(Toile, Qt::MiddleButton, kNone), Pan);
  // Two fingers on a trackpad; a pinch comes with Ctrl.
  EXPECT_EQ(wheelGestureOf(Trackpad, kNone), Turn);
  EXPECT_EQ(wheelGestureOf(Trackpad, kShift), Pan);
  EXPECT_EQ(wheelGestureOf(Trackpad, kCtrl), Zoom);
}

/// Cameras from many sides, near and far, and the screens they make.
std::vector<Camera> someCameras() {
  std::vector<Camera> all;
  for (int i = 0; i < 24; ++i) {
    Camera camera;
    camera.target = {30.0 * i - 200, 17.0 * (i % 5), 500 + 40.0 * i};
    camera.azimuth = 0.7 * i;
    camera.elevation = 1.4 * std::sin(1.3 * i);
    camera.height = 80 + 90.0 * i;
    all.push_back(camera);
  }
  return all;
}

Screen screenOf(const Camera& camera) {
  return {camera.view(), 900, 700};
}

TEST(Camera, ZoomKeepsThePointBelowTheCursorAtEveryDepth) {
  for (const Camera& camera : someCameras()) {
    const Screen screen = screenOf(camera);
    for (const Vector2d& pixel : {Vector2d(450, 350), Vector2d(12, 40), Vector2d(888, 655)}) {
      for (const double factor : {1.2, 1 / 1.2, 3.0, 0.2}) {
        const Screen after = screenOf(zoomed(camera, factor, pixel, screen));
        // On the skin, before the target's depth or behind it.
        const Ray ray = screen.rayAt(pixel);
        const double distance = (screen.view.target - screen.view.eye).norm();
        for (const double depth : {0.9, 1.0, 1.1}) {
          const Vector3d place = ray.origin + depth * distance * ray.direction.normalized();
          const auto seen = after.toPixel(place);
          // What the eye has come past is seen no more.
          if (!seen) continue;
          EXPECT_LT((*seen - pixel).norm(), 1e-6) << factor << " at " << depth;
        }
      }
    }
  }
}

TEST(Camera, ZoomEndsInBothDirectionsAndStillKeepsThePoint) {
  Camera near = someCameras().front(), far = near;
  const Vector2d pixel(100, 600);
  const Screen screen = screenOf(near);
  const Vector3d below =
      screen.rayAt(pixel).origin +
      (near.view().eye - near.target).norm() / 0.97 * screen.rayAt(pixel).direction.normalized();
  for (int i = 0; i < 200; ++i) near = zoomed(near, 1.2, pixel, screenOf(near));
  for (int i = 0; i < 200; ++i) far = zoomed(far, 1 / 1.2, pixel, screenOf(far));
  EXPECT_GE(near.height, 1);
  EXPECT_LE(far.height, 1e5);
  EXPECT_TRUE(near.target.allFinite() && far.target.allFinite());
  ASSERT_TRUE(screenOf(far).toPixel(below));
  EXPECT_LT((*screenOf(far).toPixel(below) - pixel).norm(), 1e-5);
}

TEST(Camera, PanKeepsWhatIsHeldBelowTheCursor) {
  for (const Camera& camera : someCameras()) {
    const Screen screen = screenOf(camera);
    const Vector2d from(200, 300), drag(137, -88);
    const Vector3d held = screen.view.target;
    const Vector2d at = screen.toPixel(held).value();
    const Screen after = screenOf(panned(camera, drag, screen));
    EXPECT_LT((after.toPixel(held).value() - at - drag).norm(), 1e-6);
    EXPECT_EQ(panned(camera, drag, screen).height, camera.height);
  }
}

TEST(Camera, TurningGoesRoundTheTargetAndKeepsTheVertical) {
  for (const Camera& camera : someCameras()) {
    const Screen screen = screenOf(camera);
    const Camera after = turned(camera, {250, 900}, screen);
    EXPECT_EQ(after.target, camera.target);
    EXPECT_EQ(after.height, camera.height);
    EXPECT_LE(std::abs(after.elevation), std::numbers::pi / 2) << "never upside down";
    EXPECT_GE(after.view().up.z(), -1e-12);
    // The width of the window is half a turn.
    const Camera half = turned(camera, {screen.width, 0}, screen);
    const Vector3d was = camera.view().eye - camera.target, is = half.view().eye - half.target;
    EXPECT_NEAR(was.x(), -is.x(), 1e-6);
    EXPECT_NEAR(was.y(), -is.y(), 1e-6);
  }
}

TEST(Camera, SixViewsSeeTheirSides) {
  // z up, the front towards -y, the body's left towards +x.
  const std::array<std::tuple<StandardView, Vector3d, Vector3d>, 6> sides = {{
      {StandardView::Front, {0, -1, 0}, {0, 0, 1}},
      {StandardView::Back, {0, 1, 0}, {0, 0, 1}},
      {StandardView::Left, {1, 0, 0}, {0, 0, 1}},
      {StandardView::Right, {-1, 0, 0}, {0, 0, 1}},
      {StandardView::Top, {0, 0, 1}, {0, 1, 0}},
      {StandardView::Bottom, {0, 0, -1}, {0, -1, 0}},
  }};
  const Desk desk;
  const Mesh& mesh = *desk.document().model->mesh;
  for (const Camera& start : someCameras()) {
    for (const auto& [side, from, up] : sides) {
      const Camera camera =
          fitted(seenFrom(start, side), mesh.boxMin(), mesh.boxMax(), 900.0 / 700);
      const View view = camera.view();
      EXPECT_LT(((view.eye - view.target).normalized() - from).norm(), 1e-9);
      EXPECT_LT((view.up - up).norm(), 1e-9);
      const Screen screen = screenOf(camera);
      for (std::size_t v = 0; v < mesh.vertexCount(); v += 37) {
        const auto pixel = screen.toPixel(mesh.positions()[v]);
        ASSERT_TRUE(pixel && pixel->x() > 0 && pixel->x() < 900 && pixel->y() > 0 &&
                    pixel->y() < 700)
            << "the whole body is seen";
      }
    }
  }
}

TEST(Camera, LooksStraightAtAPieceFromAnySide) {
  for (int i = 0; i < 200; ++i) {
    Vector3d normal(std::sin(12.9898 * i), std::sin(78.233 * i + 1), std::sin(39.425 * i + 2));
    if (i == 0) normal = {0, 0, 3};
    if (i == 1) normal = {0, 0, -0.5};
    const Vector3d low(-40, 10, 800), high(120, 60, 1000);
    const Camera camera =
        fitted(lookingAlong(someCameras()[static_cast<std::size_t>(i) % 24], normal), low, high,
               900.0 / 700);
    const View view = camera.view();
    const Vector3d towards = (view.target - view.eye).normalized();
    EXPECT_LT((towards + normal.normalized()).norm(), 1e-9);
    EXPECT_LT((view.target - 0.5 * (low + high)).norm(), 1e-9) << "the piece is in the middle";
    const Screen screen = screenOf(camera);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d place(corner & 1 ? low.x() : high.x(), corner & 2 ? low.y() : high.y(),
                           corner & 4 ? low.z() : high.z());
      const auto pixel = screen.toPixel(place);
      ASSERT_TRUE(pixel);
      EXPECT_TRUE(pixel->x() > 0 && pixel->x() < 900 && pixel->y() > 0 && pixel->y() < 700)
          << "and seen whole";
    }
  }
}

}  // namespace
}  // namespace toile::studio
