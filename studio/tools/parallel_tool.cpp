// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/parallel_tool.h"

#include <Eigen/Geometry>
#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "toile/edit/lines.h"
#include "toile/edit/measure.h"
#include "toile/edit/symmetry.h"
#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

constexpr double kDragStart = 4;   // px
constexpr double kLeastAside = 1;  // mm between parallels

struct Words {
  Q_DECLARE_TR_FUNCTIONS(ParallelTool)
};

/// mm over the surface from a line to a place; positive to its left.
std::optional<double> distanceFrom(const ToolHost& host, const PlacedLine& line,
                                   const RayHit& place) {
  const LinePick foot = nearestOnLine(host, line, place.position);
  const ReferenceModel& model = *host.document().model;
  if (foot.point == place.point) return 0;
  const Result<Length> way = surfaceDistance(model, foot.point, place.point);
  if (!way) return std::nullopt;
  const Vector3d along = line.points[foot.segment + 1] - line.points[foot.segment];
  const Vector3d left = line.normals[foot.segment].cross(along);
  const double side = left.dot(place.position - foot.place);
  return side < 0 ? -way->mm() : way->mm();
}

}  // namespace

void ParallelTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (pick && (pick->curve != curve_ || !moved_)) {
    host.dropPreview();
    curve_ = pick->curve;
    host.select(Selection::line(curve_));
  }
  dragging_ = !curve_.empty();
  moved_ = false;
}

void ParallelTool::move(const PointerEvent& event, ToolHost& host) {
  if (!dragging_) {
    const auto pick = pickLine(host, event.at, kLineCatch);
    hover_ = pick ? Selection::line(pick->curve) : Selection();
    return;
  }
  const auto hit = hitBody(host, event.at);
  const PlacedLine* line = host.lines().find(curve_);
  if (!hit || line == nullptr) return;
  const auto distance = distanceFrom(host, *line, *hit);
  if (!distance) return;
  const double aside = event.ctrl ? *distance : std::round(*distance);
  const double mmPerPixel = host.screen().mmPerPixelAt(hit->position);
  if (!moved_ && std::abs(aside) < std::max(kLeastAside, kDragStart * mmPerPixel)) return;
  moved_ = true;
  if (std::abs(aside) < kLeastAside) return;
  distance_ = aside;
  show(host);
}

void ParallelTool::release(const PointerEvent&, ToolHost& host) {
  if (!std::exchange(dragging_, false)) return;
  if (moved_) keep(host);
}

void ParallelTool::show(ToolHost& host) const {
  showEdit(host, offsetCurve(host.document(), curve_, Length::mm(distance_)));
}

void ParallelTool::keep(ToolHost& host) {
  const std::string curve = std::exchange(curve_, {});
  moved_ = false;
  const StylingCurve* source = nullptr;
  for (const StylingCurve& each : host.document().design->curves) {
    if (each.id == curve) source = &each;
  }
  if (source == nullptr) return;
  Result<Edited> made = offsetCurve(host.document(), curve, Length::mm(distance_));
  // A name of its own, of its kind.
  if (made) {
    const std::string name = nextCurve(host, source->kind).name;
    Design design = *made->document.design;
    for (StylingCurve& each : design.curves) {
      if (std::ranges::find(made->curves, each.id) != made->curves.end()) each.name = name;
    }
    made->document.design = std::make_shared<const Design>(std::move(design));
  }
  keepEdit(host, Words::tr("Parallel to %1").arg(titleOf(host, curve)), made);
}

void ParallelTool::cancel(ToolHost& host) {
  curve_.clear();
  dragging_ = moved_ = false;
  host.dropPreview();
}

std::optional<ToolSetting> ParallelTool::setting() const {
  return ToolSetting{Words::tr("Distance"), ToolSetting::Kind::Length, distance_};
}

void ParallelTool::set(double value, ToolHost& host) {
  if (std::abs(value) < kLeastAside) {
    return host.tell(Words::tr("The distance must be at least %1.").arg(host.lengthText(1)));
  }
  distance_ = value;
  if (curve_.empty() && host.selection().kind == Selection::Kind::Line) {
    curve_ = host.selection().id;
  }
  if (!curve_.empty()) show(host);
}

bool ParallelTool::key(ToolKey key, ToolHost& host) {
  if (curve_.empty()) return false;
  if (key == ToolKey::Escape) {
    cancel(host);
    return true;
  }
  if (key != ToolKey::Enter) return false;
  keep(host);
  return true;
}

void ParallelTool::leave(ToolHost& host) {
  hover_ = {};
  cancel(host);
}

QString ParallelTool::hint(const ToolHost&) const {
  if (curve_.empty())
    return Words::tr("<b>Parallel:</b> drag away from the line or type the distance");
  return dragging_ ? Words::tr(
                         "<b>Parallel:</b> lift to keep it · hold <Ctrl> for fractions of a "
                         "millimetre · <Esc> cancel")
                   : Words::tr(
                         "<b>Parallel:</b> drag away from the line or type the distance · "
                         "<Enter> keep · <Esc> cancel");
}

Overlay ParallelTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.hover = hover_;
  if (moved_) overlay.readOut.push_back({Words::tr("distance"), host.lengthText(distance_)});
  for (const std::string& id : newLines(host.document(), host.lines().document())) {
    const PlacedLine* line = host.lines().find(id);
    if (line == nullptr || line->curve.mirrorOf) continue;
    overlay.readOut.push_back({Words::tr("line"), host.lengthText(line->length())});
    break;
  }
  return overlay;
}

}  // namespace toile::studio
