// SPDX-License-Identifier: GPL-3.0-or-later
// Tools from plain event values: no window, no display.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "desk.h"
#include "toile/cut/cut.h"

namespace toile::studio {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(Tools, ScreenAndRayAreInverse) {
  const Desk desk;
  const Vector2d at(311, 402);
  const Ray ray = desk.screen().rayAt(at);
  const auto back = desk.screen().toPixel(ray.origin + 1234 * ray.direction.normalized());
  ASSERT_TRUE(back);
  EXPECT_NEAR((*back - at).norm(), 0, 1e-6);
}

TEST(Tools, CurveIsPreviewedAndCommittedAsOneStepWithItsTwin) {
  Desk desk;
  const auto tool = makeTool(ToolId::Curve);
  desk.click(*tool, desk.pixel(40, 1250));
  desk.click(*tool, desk.pixel(80, 1200));
  EXPECT_GT(desk.previews_, 0);
  EXPECT_TRUE(desk.steps_.empty()) << "nothing is committed before the line is finished";
  EXPECT_TRUE(tool->key(ToolKey::Enter, desk));
  ASSERT_EQ(desk.steps_.size(), 1U);
  ASSERT_EQ(desk.curves().size(), 2U);
  EXPECT_EQ(desk.curves()[1].mirrorOf, desk.curves()[0].id);
}

TEST(Tools, CurveTakesPointsBackAndEscapeLeavesNothing) {
  Desk desk;
  const auto tool = makeTool(ToolId::Curve);
  for (const double z : {1280.0, 1240.0, 1200.0}) desk.click(*tool, desk.pixel(60, z), true);
  EXPECT_TRUE(tool->key(ToolKey::Backspace, desk));
  EXPECT_TRUE(tool->key(ToolKey::Escape, desk));
  EXPECT_FALSE(tool->key(ToolKey::Escape, desk)) << "one level at a time, then the tool is left";
  EXPECT_TRUE(desk.curves().empty());
  EXPECT_TRUE(desk.lines().all().empty()) << "the preview is gone";
}

TEST(Tools, CurveClosesOnItsFirstPoint) {
  Desk desk;
  const auto tool = makeTool(ToolId::Curve);
  const Vector2d first = desk.pixel(60, 1250);
  desk.click(*tool, first, true);
  desk.click(*tool, desk.pixel(100, 1210), true);
  desk.click(*tool, desk.pixel(50, 1180), true);
  desk.click(*tool, first, true);
  ASSERT_FALSE(desk.curves().empty());
  EXPECT_TRUE(desk.curves().front().closed);
}

TEST(Tools, PencilEndsExactlyOnTheLineItIsCaughtBy) {
  Desk desk;
  const auto curve = makeTool(ToolId::Curve);
  desk.click(*curve, desk.pixel(40, 1300), true);
  desk.click(*curve, desk.pixel(110, 1290), true);
  curve->key(ToolKey::Enter, desk);
  const Vector3d end = desk.lines().find(desk.curves()[0].id)->points.back();
  const auto pencil = makeTool(ToolId::Pencil);
  desk.drag(*pencil, *desk.screen().toPixel(end) + Vector2d(4, 3), desk.pixel(105, 1150));
  ASSERT_EQ(desk.curves().size(), 4U);
  const Vector3d start = desk.lines().find(desk.curves()[2].id)->points.front();
  EXPECT_LT((start - end).norm(), kMergeDistanceMm);
}

TEST(Tools, PencilMakesNoHookWhereItsEndIsCaught) {
  Desk desk;
  const auto curve = makeTool(ToolId::Curve);
  desk.click(*curve, desk.pixel(40, 1300), true);
  desk.click(*curve, desk.pixel(110, 1290), true);
  curve->key(ToolKey::Enter, desk);
  const Vector3d end = desk.lines().find(desk.curves()[0].id)->points.back();
  const auto pencil = makeTool(ToolId::Pencil);
  // The hand passes the end by some pixels before it lifts.
  desk.drag(*pencil, desk.pixel(105, 1150), *desk.screen().toPixel(end) + Vector2d(6, -6));
  ASSERT_EQ(desk.curves().size(), 4U);
  const auto& points = desk.lines().find(desk.curves()[2].id)->points;
  const Vector3d before = (points.back() - points[points.size() - 2]).normalized();
  const Vector3d whole = (points.back() - points.front()).normalized();
  EXPECT_LT((points.back() - end).norm(), kMergeDistanceMm);
  EXPECT_GT(before.dot(whole), 0.8) << "it arrives as it came";
}

TEST(Tools, PencilStrokeThrownAwayByEscape) {
  Desk desk;
  const auto pencil = makeTool(ToolId::Pencil);
  desk.drag(*pencil, desk.pixel(40, 1300), desk.pixel(90, 1150), /*release=*/false);
  EXPECT_TRUE(pencil->isBusy());
  EXPECT_TRUE(pencil->key(ToolKey::Escape, desk));
  EXPECT_TRUE(desk.curves().empty());
}

TEST(Tools, SymmetryOffDrawsOneLine) {
  Desk desk;
  desk.options_.symmetry = false;
  desk.drag(*makeTool(ToolId::Pencil), desk.pixel(40, 1300), desk.pixel(90, 1150));
  EXPECT_EQ(desk.curves().size(), 1U);
}

class ToolsOnALine : public testing::Test {
 protected:
  void SetUp() override {
    const auto curve = makeTool(ToolId::Curve);
    for (const auto& [x, z] : {std::pair{40, 1300}, {80, 1240}, {60, 1160}}) {
      desk.click(*curve, desk.pixel(x, z), true);
    }
    curve->key(ToolKey::Enter, desk);
    id = desk.curves()[0].id;
  }
  Vector2d onLine(double part) {
    const auto& points = desk.lines().find(id)->points;
    return *desk.screen().toPixel(points[static_cast<std::size_t>(part * (points.size() - 1))]);
  }
  Desk desk;
  std::string id;
};

TEST_F(ToolsOnALine, SelectPicksMovesAndPutsBack) {
  const auto select = makeTool(ToolId::Select);
  desk.click(*select, onLine(0.3));
  ASSERT_TRUE(desk.selection().isLine(id));
  const Overlay overlay = select->overlay(desk);
  ASSERT_GE(overlay.points.size(), 3U);
  const Vector3d point = overlay.points[1].place;
  const Vector2d at = *desk.screen().toPixel(point);

  desk.drag(*select, at, at + Vector2d(12, 8), /*release=*/false);
  EXPECT_TRUE(select->isBusy());
  EXPECT_TRUE(select->key(ToolKey::Escape, desk));
  EXPECT_EQ(desk.steps_.size(), 1U) << "put back: no step";

  desk.drag(*select, at, at + Vector2d(12, 8));
  ASSERT_EQ(desk.steps_.size(), 2U) << "a gesture is one step";
  const auto& points = desk.lines().find(id)->points;
  double nearest = 1e9;
  for (const Vector3d& p : points) nearest = std::min(nearest, (p - point).norm());
  EXPECT_GT(nearest, 2);
  EXPECT_EQ(desk.lines().all().size(), 2U) << "the twin moved along";
}

TEST_F(ToolsOnALine, DeleteTakesTheTwinToo) {
  const auto select = makeTool(ToolId::Select);
  desk.click(*select, onLine(0.3));
  EXPECT_TRUE(select->key(ToolKey::Delete, desk));
  EXPECT_TRUE(desk.curves().empty());
}

TEST_F(ToolsOnALine, SplitParts) {
  desk.click(*makeTool(ToolId::Split), onLine(0.5));
  EXPECT_EQ(desk.curves().size(), 4U) << "both parts and their twins";
}

TEST_F(ToolsOnALine, DartOpensOnTheLine) {
  const auto dart = makeTool(ToolId::Dart);
  desk.click(*dart, desk.pixel(20, 1000));
  EXPECT_FALSE(desk.told_.isEmpty()) << "a dart needs a line";
  desk.click(*dart, onLine(0.5));
  desk.click(*dart, desk.pixel(30, 1230), true);
  EXPECT_EQ(std::ranges::count(desk.curves(), CurveKind::Dart, &StylingCurve::kind), 2)
      << "the dart and its twin";
}

TEST(Tools, GirthIsClosedAndLevel) {
  Desk desk;
  const auto tool = makeTool(ToolId::Girth);
  desk.click(*tool, desk.pixel(10, 1100), true);
  ASSERT_EQ(desk.curves().size(), 1U) << "symmetric by itself: no twin";
  EXPECT_TRUE(desk.curves()[0].closed);
  const auto& points = desk.lines().all()[0]->points;
  for (const Vector3d& p : points) EXPECT_NEAR(p.z(), points[0].z(), 2.0);
}

TEST(Tools, LeastLengthLinksTwoClicks) {
  Desk desk;
  const auto tool = makeTool(ToolId::LeastLength);
  desk.click(*tool, desk.pixel(40, 1300), true);
  desk.click(*tool, desk.pixel(80, 1150), true);
  EXPECT_EQ(desk.curves().size(), 2U);
}

}  // namespace
}  // namespace toile::studio
