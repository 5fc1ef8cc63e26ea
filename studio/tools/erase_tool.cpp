// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/erase_tool.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "tools/drawing.h"

namespace toile::studio {

namespace {

constexpr double kShortest = 2;  // mm that a part must have to be erased

struct Words {
  Q_DECLARE_TR_FUNCTIONS(EraseTool)
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

}  // namespace

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

}  // namespace toile::studio
