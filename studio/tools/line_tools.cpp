// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/line_tools.h"

#include <Eigen/Geometry>
#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "toile/edit/measure.h"
#include "toile/edit/symmetry.h"
#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

constexpr double kShortest = 2;    // mm that a part must have to be erased
constexpr double kDragStart = 4;   // px
constexpr double kLeastAside = 1;  // mm between parallels

struct Words {
  Q_DECLARE_TR_FUNCTIONS(LineTools)
};

/// The points of a stretch of a line, with their normals.
OverlayLine partOf(const PlacedLine& line, const Stretch& stretch) {
  OverlayLine part;
  part.kind = line.curve.kind;
  part.style = OverlayLine::Style::Remove;
  const double length = line.length();
  const auto add = [&](double from, double to) {
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const double at = line.arc[i] / length;
      if (at < from || at > to) continue;
      part.points.push_back(line.points[i]);
      part.normals.push_back(line.normals[i]);
    }
  };
  if (stretch.from <= stretch.to) {
    add(stretch.from, stretch.to);
  } else {
    add(stretch.from, 1);
    add(0, stretch.to);
  }
  return part;
}

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

// ---- extend

std::optional<ExtendTool::End> ExtendTool::endNear(const PointerEvent& event,
                                                   const ToolHost& host) {
  const auto pick = pickLine(host, event.at, 2 * kLineCatch);
  const PlacedLine* line = pick ? host.lines().find(pick->curve) : nullptr;
  if (line == nullptr || line->path.closed) return std::nullopt;
  const bool atStart = pick->fraction < 0.5;
  return End{pick->curve, atStart ? CurveEnd::Start : CurveEnd::End,
             atStart ? line->points.front() : line->points.back(),
             atStart ? line->normals.front() : line->normals.back()};
}

void ExtendTool::move(const PointerEvent& event, ToolHost& host) {
  if (!taken_) {
    hover_ = endNear(event, host);
    return;
  }
  host.dropPreview();
  const auto other = pickLine(host, event.at, kLineCatch, {taken_->curve});
  if (!other) return;
  const Result<Document> made =
      extendToCurve(host.document(), taken_->curve, taken_->end, other->curve);
  if (made) host.preview(*made, /*withPattern=*/false);
}

void ExtendTool::press(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  if (!taken_) {
    const auto end = endNear(event, host);
    if (end && !refuseLocked(host, end->curve)) taken_ = end;
    return;
  }
  const auto other = pickLine(host, event.at, kLineCatch, {taken_->curve});
  if (!other) return host.tell(Words::tr("Click the line that it shall run to."));
  const End end = *taken_;
  taken_.reset();
  hover_.reset();
  keepEdit(host, Words::tr("Extend %1").arg(titleOf(host, end.curve)),
           extendToCurve(host.document(), end.curve, end.end, other->curve));
}

bool ExtendTool::key(ToolKey key, ToolHost& host) {
  if ((key != ToolKey::Escape && key != ToolKey::Backspace) || !taken_) return false;
  taken_.reset();
  host.dropPreview();
  return true;
}

void ExtendTool::leave(ToolHost& host) {
  taken_.reset();
  hover_.reset();
  host.dropPreview();
}

QString ExtendTool::hint(const ToolHost&) const {
  return taken_ ? Words::tr("<b>Extend:</b> click the line that it shall run to · <Esc> cancel")
                : Words::tr("<b>Extend:</b> click a line near the end that is too short");
}

Overlay ExtendTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  if (hover_ && !taken_) {
    overlay.points.push_back({hover_->place, hover_->normal, OverlayPoint::Shape::Tip});
    overlay.hover = Selection::line(hover_->curve);
  }
  if (!taken_) return overlay;
  overlay.points.push_back({taken_->place, taken_->normal, OverlayPoint::Shape::Active});
  if (const PlacedLine* line = host.lines().find(taken_->curve)) {
    overlay.readOut.push_back({Words::tr("line"), host.lengthText(line->length())});
  }
  return overlay;
}

// ---- erase

Stretch EraseTool::stretch(bool closed) const {
  Stretch stretch{std::min(from_, to_), std::max(from_, to_)};
  if (!closed || stretch.to - stretch.from >= 1) {
    return {std::max(0.0, stretch.from), std::min(1.0, stretch.to)};
  }
  return {stretch.from - std::floor(stretch.from), stretch.to - std::floor(stretch.to)};
}

void EraseTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick || refuseLocked(host, pick->curve)) return;
  curve_ = pick->curve;
  from_ = to_ = pick->fraction;
}

void EraseTool::move(const PointerEvent& event, ToolHost& host) {
  if (curve_.empty()) {
    hover_ = pickLine(host, event.at, kLineCatch);
    return;
  }
  const auto hit = hitBody(host, event.at);
  const PlacedLine* line = host.lines().find(curve_);
  if (!hit || line == nullptr) return;
  double to = nearestOnLine(host, *line, hit->position).fraction;
  if (line->path.closed) to += std::round(to_ - to);
  to_ = to;
}

void EraseTool::release(const PointerEvent& event, ToolHost& host) {
  if (curve_.empty()) return;
  move(event, host);
  const std::string curve = std::exchange(curve_, {});
  const PlacedLine* line = host.lines().find(curve);
  const Stretch part = stretch(line->path.closed);
  const double length = std::abs(to_ - from_) * line->length();
  if (length < kShortest) {
    return host.tell(Words::tr("Draw along the part of the line that should go."));
  }
  const double kept = (1 - std::abs(to_ - from_)) * line->length();
  if (kept < kShortest) {
    return host.tell(Words::tr("All of the line is marked: select it and press Delete."));
  }
  // Twins are parted alike by the engine; free lines stay free.
  const Result<Edited> made = eraseStretch(host.document(), curve, part);
  if (!made) return host.tell(QString::fromStdString(made.error().message));
  host.commit(Words::tr("Erase part of %1").arg(titleOf(host, curve)), made->document);
}

bool EraseTool::key(ToolKey key, ToolHost&) {
  if (key != ToolKey::Escape || curve_.empty()) return false;
  curve_.clear();
  return true;
}

void EraseTool::leave(ToolHost&) {
  curve_.clear();
  hover_.reset();
}

QString EraseTool::hint(const ToolHost&) const {
  return curve_.empty()
             ? Words::tr("<b>Erase:</b> draw along the part that should go")
             : Words::tr("<b>Erase:</b> lift to take the marked part away · <Esc> keeps it");
}

Overlay EraseTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  if (curve_.empty()) {
    if (hover_) overlay.hover = Selection::line(hover_->curve);
    return overlay;
  }
  const PlacedLine* line = host.lines().find(curve_);
  if (line == nullptr) return overlay;
  overlay.lines.push_back(partOf(*line, stretch(line->path.closed)));
  overlay.readOut.push_back(
      {Words::tr("goes"), host.lengthText(std::abs(to_ - from_) * line->length())});
  return overlay;
}

// ---- parallel

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

// ---- mirror copy

void MirrorCopyTool::show(ToolHost& host) const {
  if (curves_.empty()) return host.dropPreview();
  const Result<Edited> made = mirrorCurves(host.document(), curves_, host.options().symmetry);
  if (made) {
    host.preview(made->document, /*withPattern=*/false);
  } else {
    host.dropPreview();
  }
}

void MirrorCopyTool::move(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  hover_ = pick ? Selection::line(pick->curve) : Selection();
}

void MirrorCopyTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick) return;
  if (!host.document().model->symmetry) {
    return host.tell(Words::tr("This body has no left and right to copy between."));
  }
  const auto& curves = host.document().design->curves;
  if (std::ranges::none_of(curves, [&](const auto& c) { return c.id == pick->curve; })) return;
  const bool hasTwin = std::ranges::any_of(curves, [&](const StylingCurve& c) {
    return c.mirrorOf == pick->curve || (c.id == pick->curve && c.mirrorOf);
  });
  if (hasTwin) {
    return host.tell(Words::tr("%1 has a twin already.").arg(titleOf(host, pick->curve)));
  }
  const auto known = std::ranges::find(curves_, pick->curve);
  if (known != curves_.end()) {
    curves_.erase(known);
  } else {
    curves_.push_back(pick->curve);
  }
  show(host);
}

bool MirrorCopyTool::key(ToolKey key, ToolHost& host) {
  if (curves_.empty()) return false;
  switch (key) {
    case ToolKey::Enter: {
      const QString step =
          curves_.size() == 1
              ? Words::tr("Mirror copy of %1").arg(titleOf(host, curves_.front()))
              : Words::tr("Mirror copy of %n lines", nullptr, static_cast<int>(curves_.size()));
      const Result<Edited> made = mirrorCurves(host.document(), curves_, host.options().symmetry);
      curves_.clear();
      host.dropPreview();
      if (!made) {
        host.tell(QString::fromStdString(made.error().message));
      } else {
        host.commit(step, made->document);
      }
      return true;
    }
    case ToolKey::Backspace:
      curves_.pop_back();
      show(host);
      return true;
    case ToolKey::Escape:
      curves_.clear();
      host.dropPreview();
      return true;
    default:
      return false;
  }
}

void MirrorCopyTool::leave(ToolHost& host) {
  curves_.clear();
  hover_ = {};
  host.dropPreview();
}

QString MirrorCopyTool::hint(const ToolHost& host) const {
  if (curves_.empty())
    return Words::tr("<b>Mirror copy:</b> click lines, <Enter> copies them to the other side");
  return host.options().symmetry
             ? Words::tr(
                   "<b>Mirror copy:</b> <Enter> makes linked twins · click more lines · "
                   "<Backspace> take the last back · <Esc> cancel")
             : Words::tr(
                   "<b>Mirror copy:</b> <Enter> makes free copies · click more lines · "
                   "<Backspace> take the last back · <Esc> cancel");
}

Overlay MirrorCopyTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.showMiddle = true;
  overlay.hover = hover_;
  for (const std::string& id : curves_) {
    const PlacedLine* line = host.lines().find(id);
    if (line == nullptr) continue;
    overlay.lines.push_back(
        {line->points, line->normals, line->curve.kind, OverlayLine::Style::Picked});
  }
  return overlay;
}

}  // namespace toile::studio
