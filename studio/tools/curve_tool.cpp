// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/curve_tool.h"

#include <QCoreApplication>

#include "tools/drawing.h"

namespace toile::studio {

namespace {

/// mm within which two clicks mean one point.
constexpr double kSamePlace = 0.5;

struct Words {
  Q_DECLARE_TR_FUNCTIONS(CurveTool)
};

std::vector<SurfacePoint> placesOf(const std::vector<Snapped>& points) {
  std::vector<SurfacePoint> places;
  for (const Snapped& point : points) places.push_back(point.point);
  return places;
}

}  // namespace

void CurveTool::press(const PointerEvent& event, ToolHost& host) {
  move(event, host);
  if (closes_) return finish(/*closed=*/true, host);
  if (!next_) return;
  if (!points_.empty() && (points_.back().place - next_->place).norm() < kSamePlace) return;
  points_.push_back(*next_);
  show(host);
}

void CurveTool::move(const PointerEvent& event, ToolHost& host) {
  next_ = snap(host, event, {drawn_, drawn_ + "-mirror"});
  closes_ = false;
  if (points_.size() >= 3) {
    const auto pixel = host.screen().toPixel(points_.front().place);
    closes_ = pixel && (*pixel - event.at).norm() <= event.catchRadius();
  }
  show(host);
}

void CurveTool::show(ToolHost& host) {
  std::vector<SurfacePoint> places = placesOf(points_);
  const bool isNew =
      next_ && (points_.empty() || (points_.back().place - next_->place).norm() >= kSamePlace);
  if (isNew && !closes_) places.push_back(next_->point);
  if (places.size() < 2) return host.dropPreview();
  const Result<Edited> drawn = drawThrough(host.document(), places, closes_, nextCurve(host));
  if (!drawn) return;  // the last preview stays; the next move may lead on
  drawn_ = drawn->curves.empty() ? "" : drawn->curves.front();
  host.preview(withTwins(host, *drawn), /*withPattern=*/false);
}

void CurveTool::finish(bool closed, ToolHost& host) {
  if (points_.size() < 2) return cancel(host);
  const NewCurve curve = nextCurve(host);
  const Result<Edited> drawn = drawThrough(host.document(), placesOf(points_), closed, curve);
  if (!drawn) return host.tell(QString::fromStdString(drawn.error().message));
  points_.clear();
  next_.reset();
  closes_ = false;
  drawn_.clear();
  host.commit(Words::tr("Curve, %1").arg(QString::fromStdString(curve.name)),
              withTwins(host, *drawn));
  host.select(Selection::line(drawn->curves.front()));
}

void CurveTool::cancel(ToolHost& host) {
  points_.clear();
  closes_ = false;
  drawn_.clear();
  host.dropPreview();
}

void CurveTool::doubleClick(const PointerEvent&, ToolHost& host) {
  finish(/*closed=*/false, host);
}

bool CurveTool::key(ToolKey key, ToolHost& host) {
  if (points_.empty()) return false;
  switch (key) {
    case ToolKey::Enter:
      finish(/*closed=*/false, host);
      return true;
    case ToolKey::Escape:
      cancel(host);
      return true;
    case ToolKey::Backspace:
    case ToolKey::Delete:
      points_.pop_back();
      show(host);
      return true;
    default:
      return false;
  }
}

void CurveTool::leave(ToolHost& host) {
  next_.reset();
  cancel(host);
}

QString CurveTool::hint(const ToolHost&) const {
  if (points_.empty()) return Words::tr("<b>Curve:</b> click the first point");
  if (closes_) return Words::tr("<b>Curve:</b> click to close the line");
  return Words::tr(
      "<b>Curve:</b> click to add a point · <Enter> finish · <Backspace> take the last point back "
      "· "
      "hold <Ctrl> to ignore snapping · <Esc> cancel");
}

Overlay CurveTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.showMiddle = host.options().symmetry;
  for (const Snapped& point : points_) {
    overlay.points.push_back({point.place, point.normal, OverlayPoint::Shape::Control});
  }
  if (next_) {
    overlay.snap = next_->mark;
    if (!points_.empty()) {
      overlay.points.push_back({next_->place, next_->normal, OverlayPoint::Shape::Tip});
      overlay.readOut.push_back(
          {Words::tr("span"), host.lengthText((next_->place - points_.back().place).norm())});
    }
  }
  if (const PlacedLine* line = drawn_.empty() ? nullptr : host.lines().find(drawn_)) {
    overlay.readOut.push_back({Words::tr("line"), host.lengthText(line->length())});
  }
  return overlay;
}

CursorShape CurveTool::cursor() const {
  return closes_ ? CursorShape::CrossRing : CursorShape::Cross;
}

}  // namespace toile::studio
