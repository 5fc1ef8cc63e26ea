// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that change lines, fair them and measure, from plain event values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "desk.h"
#include "toile/edit/lines.h"
#include "toile/edit/measure.h"

namespace toile::studio {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Two free lines on the left half of the front: one down, one across below it.
class EditTools : public testing::Test {
 protected:
  void SetUp() override {
    desk.options_.symmetry = false;
    desk.options_.snap = false;
    down = draw({{60, 1300}, {70, 1240}, {60, 1180}});
    across = draw({{20, 1120}, {60, 1125}, {100, 1120}});
  }
  std::string draw(std::initializer_list<std::pair<double, double>> points) {
    const auto curve = makeTool(ToolId::Curve);
    for (const auto& [x, z] : points) desk.click(*curve, desk.pixel(x, z));
    curve->key(ToolKey::Enter, desk);
    return desk.curves().back().id;
  }
  const PlacedLine& line(const std::string& id) const { return *desk.lines().find(id); }
  Vector2d on(const std::string& id, double part) const {
    const PlacedLine& placed = line(id);
    const double arc = part * placed.length();
    std::size_t i = 0;
    while (i + 1 < placed.arc.size() && placed.arc[i] < arc) ++i;
    return *desk.screen().toPixel(placed.points[i]);
  }
  void lock(const std::string& id) {
    Design design = *desk.document().design;
    for (StylingCurve& curve : design.curves) {
      if (curve.id == id) curve.unknown["locked"] = "true";
    }
    desk.document_.design = std::make_shared<const Design>(std::move(design));
    desk.lines_.update(desk.document_);
  }
  std::string readOut(const Tool& tool, const char* word) const {
    for (const ReadOut& row : tool.overlay(desk).readOut) {
      if (row.word == QLatin1String(word)) return row.value.toStdString();
    }
    return {};
  }
  Desk desk;
  std::string down, across;
};

TEST_F(EditTools, ExtendRunsToTheLineThatIsClicked) {
  const double before = line(down).length();
  const auto tool = makeTool(ToolId::Extend);
  desk.click(*tool, on(down, 0.95));
  EXPECT_TRUE(desk.steps_.size() == 2) << "the first click only takes the end";
  PointerEvent event;
  event.at = on(across, 0.5);
  tool->move(event, desk);
  EXPECT_GT(line(down).length(), before + 30) << "the preview shows the longer line";
  EXPECT_EQ(desk.steps_.size(), 2U);
  tool->press(event, desk);
  ASSERT_EQ(desk.steps_.size(), 3U);
  const auto meetings = meetingsOf(desk.document(), down, across);
  ASSERT_TRUE(meetings);
  EXPECT_EQ(meetings->size(), 1U) << "it ends on the other line";
}

TEST_F(EditTools, ExtendIsGivenUpByEscape) {
  const auto tool = makeTool(ToolId::Extend);
  desk.click(*tool, on(down, 0.95));
  EXPECT_TRUE(tool->key(ToolKey::Escape, desk));
  EXPECT_FALSE(tool->key(ToolKey::Escape, desk));
  desk.click(*tool, on(across, 0.5));
  EXPECT_EQ(desk.steps_.size(), 2U) << "a click after that takes an end again";
}

TEST_F(EditTools, EraseTakesTheMiddleAway) {
  const double before = line(down).length();
  desk.drag(*makeTool(ToolId::Erase), on(down, 0.35), on(down, 0.65));
  ASSERT_EQ(desk.steps_.size(), 3U);
  ASSERT_EQ(desk.curves().size(), 3U) << "two parts and the other line";
  double left = 0;
  for (const auto& each : desk.lines().all()) {
    if (each->curve.id != across) left += each->length();
  }
  EXPECT_NEAR(left, 0.7 * before, 0.05 * before);
}

TEST_F(EditTools, EraseMarksThePartAndEscapeKeepsIt) {
  const auto tool = makeTool(ToolId::Erase);
  desk.drag(*tool, on(down, 0.3), on(down, 0.7), /*release=*/false);
  const Overlay overlay = tool->overlay(desk);
  ASSERT_EQ(overlay.lines.size(), 1U);
  EXPECT_EQ(overlay.lines[0].style, OverlayLine::Style::Remove);
  EXPECT_TRUE(tool->key(ToolKey::Escape, desk));
  EXPECT_EQ(desk.steps_.size(), 2U);
}

TEST_F(EditTools, EraseOfALinkedLineLeavesBothSidesAlike) {
  Desk both;
  const auto curve = makeTool(ToolId::Curve);
  for (const auto& [x, z] : {std::pair{60, 1300}, {70, 1240}, {60, 1180}}) {
    both.click(*curve, both.pixel(x, z), true);
  }
  curve->key(ToolKey::Enter, both);
  ASSERT_EQ(both.curves().size(), 2U);
  const auto& points = both.lines().find(both.curves()[0].id)->points;
  const auto at = [&](double part) {
    return *both.screen().toPixel(points[static_cast<std::size_t>(part * double(points.size()))]);
  };
  both.drag(*makeTool(ToolId::Erase), at(0.4), at(0.6));
  double left = 0, right = 0;
  for (const auto& each : both.lines().all()) {
    (each->points.front().x() > 0 ? left : right) += each->length();
  }
  EXPECT_NEAR(left, right, 0.5) << "what goes on one side goes on the other";
}

TEST_F(EditTools, LockedLinesStayAsTheyAre) {
  lock(down);
  desk.drag(*makeTool(ToolId::Erase), on(down, 0.35), on(down, 0.65));
  desk.click(*makeTool(ToolId::Split), on(down, 0.5));
  desk.click(*makeTool(ToolId::Extend), on(down, 0.95));
  const auto fair = makeTool(ToolId::Fair);
  desk.click(*fair, on(down, 0.5));
  fair->key(ToolKey::Enter, desk);
  EXPECT_EQ(desk.steps_.size(), 2U);
  EXPECT_TRUE(desk.told_.contains(QLatin1String("locked")));
}

TEST_F(EditTools, ParallelRunsWhereItIsDraggedTo) {
  const auto tool = makeTool(ToolId::Parallel);
  const Vector2d from = on(down, 0.5);
  const double pixels = 25 / desk.screen().mmPerPixelAt(line(down).points.front());
  desk.drag(*tool, from, from + Vector2d(pixels, 0));
  ASSERT_EQ(desk.steps_.size(), 3U) << "let go, it is kept";
  ASSERT_EQ(desk.curves().size(), 3U);
  const PlacedLine& beside = line(desk.curves().back().id);
  const ReferenceModel& model = *desk.document().model;
  const std::size_t middle = beside.points.size() / 2;
  const LinePick foot = nearestOnLine(desk, line(down), beside.points[middle]);
  const auto apart = surfaceDistance(model, beside.path.points[middle], foot.point);
  ASSERT_TRUE(apart);
  EXPECT_NEAR(apart->mm(), 25, 4) << "about as far as the pointer went";
}

TEST_F(EditTools, ParallelTakesATypedDistance) {
  const auto tool = makeTool(ToolId::Parallel);
  desk.click(*tool, on(down, 0.5));
  ASSERT_TRUE(tool->setting());
  EXPECT_EQ(tool->setting()->kind, ToolSetting::Kind::Length);
  tool->set(40, desk);
  EXPECT_EQ(desk.steps_.size(), 2U) << "shown, not kept";
  EXPECT_EQ(desk.lines().all().size(), 3U);
  EXPECT_TRUE(tool->key(ToolKey::Enter, desk));
  ASSERT_EQ(desk.steps_.size(), 3U);
  const PlacedLine& beside = line(desk.curves().back().id);
  const std::size_t middle = beside.points.size() / 2;
  const LinePick foot = nearestOnLine(desk, line(down), beside.points[middle]);
  EXPECT_NEAR((foot.place - beside.points[middle]).norm(), 40, 2);
  EXPECT_NE(beside.curve.name, line(down).curve.name);
}

TEST_F(EditTools, MirrorCopyMakesFreeOrLinkedTwins) {
  for (const bool linked : {false, true}) {
    Desk each = desk;
    each.options_.symmetry = linked;
    const auto tool = makeTool(ToolId::MirrorCopy);
    each.click(*tool, on(down, 0.5));
    each.click(*tool, on(across, 0.3));
    EXPECT_EQ(each.lines().all().size(), 4U) << "previewed";
    EXPECT_TRUE(tool->key(ToolKey::Backspace, each));
    EXPECT_EQ(each.lines().all().size(), 3U) << "the last one is taken back";
    EXPECT_TRUE(tool->key(ToolKey::Enter, each));
    ASSERT_EQ(each.curves().size(), 3U);
    EXPECT_EQ(each.curves().back().mirrorOf.has_value(), linked);
    const PlacedLine& copy = *each.lines().find(each.curves().back().id);
    const PlacedLine& original = *each.lines().find(down);
    EXPECT_NEAR(copy.length(), original.length(), 0.2);
    EXPECT_LT(copy.points.front().x() * original.points.front().x(), 0);
  }
}

TEST_F(EditTools, FairCalmsAndIsKeptByEnter) {
  const std::string wavy =
      draw({{20, 1080}, {35, 1092}, {50, 1076}, {65, 1091}, {80, 1077}, {95, 1088}});
  const auto tool = makeTool(ToolId::Fair);
  desk.click(*tool, on(wavy, 0.5));
  const double before = line(wavy).length();
  tool->set(0.95, desk);
  EXPECT_LT(line(wavy).length(), before) << "shown calmer";
  EXPECT_EQ(desk.steps_.size(), 3U) << "not kept yet";
  const Overlay overlay = tool->overlay(desk);
  EXPECT_TRUE(std::ranges::any_of(overlay.lines, [](const OverlayLine& each) {
    return each.style == OverlayLine::Style::Comb;
  })) << "with its comb";
  EXPECT_TRUE(tool->key(ToolKey::Enter, desk));
  EXPECT_EQ(desk.steps_.size(), 4U);
  EXPECT_LT(line(wavy).length(), before);
}

TEST_F(EditTools, FairFollowsADragAndEscapeLeavesTheLine) {
  const std::string wavy = draw({{20, 1080}, {50, 1066}, {80, 1085}});
  const double before = line(wavy).length();
  const auto tool = makeTool(ToolId::Fair);
  const Vector2d at = on(wavy, 0.5);
  desk.drag(*tool, at, at + Vector2d(150, 0));
  EXPECT_GT(tool->setting()->value, 0.3);
  EXPECT_TRUE(tool->key(ToolKey::Escape, desk));
  EXPECT_NEAR(line(wavy).length(), before, 1e-9);
  EXPECT_EQ(desk.steps_.size(), 3U);
}

TEST_F(EditTools, MeasureTellsLengthsOfLinesAndGirths) {
  const auto tool = makeTool(ToolId::Measure);
  PointerEvent event;
  event.at = on(down, 0.5);
  tool->move(event, desk);
  EXPECT_EQ(readOut(*tool, line(down).title().c_str()),
            desk.lengthText(line(down).length()).toStdString());
  event.at = desk.pixel(-60, 1200);
  tool->move(event, desk);
  const Overlay overlay = tool->overlay(desk);
  const std::string girth = readOut(*tool, "girth");
  ASSERT_FALSE(girth.empty());
  const auto hit = hitBody(desk, event.at);
  const auto expected = girthThrough(*desk.document().model, hit->point, {0, 0, 1});
  ASSERT_TRUE(expected);
  EXPECT_NEAR(std::stod(girth), expected->mm(), 0.2);
}

TEST_F(EditTools, MeasureTellsTheWayBetweenTwoClicks) {
  const auto tool = makeTool(ToolId::Measure);
  const Vector2d a = desk.pixel(-90, 1300), b = desk.pixel(-30, 1150);
  desk.click(*tool, a);
  desk.click(*tool, b);
  const Overlay overlay = tool->overlay(desk);
  ASSERT_EQ(overlay.labels.size(), 1U);
  const double onSurface = overlay.labels[0].rows[0].value.toDouble();
  const double straight = overlay.labels[0].rows[1].value.toDouble();
  const auto expected =
      surfaceDistance(*desk.document().model, hitBody(desk, a)->point, hitBody(desk, b)->point);
  ASSERT_TRUE(expected);
  EXPECT_NEAR(onSurface, expected->mm(), 0.1);
  EXPECT_LT(straight, onSurface);
  EXPECT_TRUE(tool->key(ToolKey::Escape, desk));
  EXPECT_TRUE(tool->overlay(desk).labels.empty());
}

TEST_F(EditTools, MeasureTellsTheAngleOfACrossing) {
  const std::string crossing = draw({{60, 1150}, {60, 1125}, {62, 1090}});
  const auto meetings = meetingsOf(desk.document(), crossing, across);
  ASSERT_TRUE(meetings);
  ASSERT_EQ(meetings->size(), 1U);
  const auto tool = makeTool(ToolId::Measure);
  PointerEvent event;
  event.at =
      *desk.screen().toPixel(position(*desk.document().model->mesh, meetings->front().point));
  tool->move(event, desk);
  bool hasAngle = false;
  for (const ReadOut& row : tool->overlay(desk).readOut) {
    if (!row.word.startsWith(QLatin1String("angle"))) continue;
    hasAngle = true;
    const double shown = row.value.chopped(1).toDouble();
    const double angle = meetings->front().angle.degrees();
    EXPECT_TRUE(std::abs(shown - angle) < 0.1 || std::abs(180 - shown - angle) < 0.1);
  }
  EXPECT_TRUE(hasAngle);
}

}  // namespace
}  // namespace toile::studio
