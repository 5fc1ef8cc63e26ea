// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/extend_tool.h"

#include <QCoreApplication>

#include "tools/drawing.h"

namespace toile::studio {

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(ExtendTool)
};

}  // namespace

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

}  // namespace toile::studio
