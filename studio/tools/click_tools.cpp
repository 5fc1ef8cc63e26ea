// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/click_tools.h"

#include <QCoreApplication>

#include "toile/edit/lines.h"
#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(ClickTools)
};

}  // namespace

bool ClickTool::key(ToolKey key, ToolHost& host) {
  if (key != ToolKey::Escape || !first_) return false;
  first_.reset();
  host.dropPreview();
  return true;
}

void ClickTool::leave(ToolHost& host) {
  first_.reset();
  next_.reset();
  host.dropPreview();
}

Overlay ClickTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.showMiddle = host.options().symmetry;
  if (first_) {
    overlay.points.push_back({first_->place, first_->normal, OverlayPoint::Shape::Control});
  }
  if (next_) overlay.snap = next_->mark;
  for (const std::string& id : newLines(host.document(), host.lines().document())) {
    if (const PlacedLine* line = host.lines().find(id); line != nullptr && !line->curve.mirrorOf) {
      overlay.readOut.push_back({Words::tr("line"), host.lengthText(line->length())});
      break;
    }
  }
  return overlay;
}

// ---- least length

void LeastLengthTool::move(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  next_ = snap(host, event);
  if (!first_ || !next_) return;
  const std::vector<SurfacePoint> points{first_->point, next_->point};
  showEdit(host, drawShortest(host.document(), points, nextCurve(host)));
}

void LeastLengthTool::press(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  next_ = snap(host, event);
  if (!next_) return;
  if (!first_) {
    first_ = next_;
    return;
  }
  const std::vector<SurfacePoint> points{first_->point, next_->point};
  const NewCurve curve = nextCurve(host);
  first_.reset();
  keepEdit(host, Words::tr("Least length, %1").arg(QString::fromStdString(curve.name)),
           drawShortest(host.document(), points, curve));
}

QString LeastLengthTool::hint(const ToolHost&) const {
  return first_ ? Words::tr("<b>Least length:</b> click where it ends · <Esc> cancel")
                : Words::tr("<b>Least length:</b> click where it starts");
}

// ---- girth

namespace {

/// Level; with Shift, square to what is up on the screen.
Vector3d girthNormal(const PointerEvent& event, const ToolHost& host) {
  return event.shift ? host.screen().view.up : Vector3d(0, 0, 1);
}

}  // namespace

void GirthTool::move(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  next_ = snap(host, event);
  if (!next_) return;
  showEdit(host,
           drawGirth(host.document(), next_->point, girthNormal(event, host), nextCurve(host)));
}

void GirthTool::press(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  next_ = snap(host, event);
  if (!next_) return;
  const NewCurve curve = nextCurve(host);
  keepEdit(host, Words::tr("Girth, %1").arg(QString::fromStdString(curve.name)),
           drawGirth(host.document(), next_->point, girthNormal(event, host), curve));
}

QString GirthTool::hint(const ToolHost&) const {
  return Words::tr("<b>Girth:</b> point at the body, click to take the girth · <Shift> tilts it");
}

// ---- dart

void DartTool::move(const PointerEvent& event, ToolHost& host) {
  if (!first_) {
    const auto pick = pickLine(host, event.at, kLineCatch);
    next_.reset();
    if (!pick) return;
    next_ = Snapped{pick->point, pick->place, Vector3d::Zero(),
                    SnapMark{SnapMark::Kind::Line, pick->place,
                             Words::tr("on %1").arg(titleOf(host, pick->curve))},
                    pick->curve};
    return;
  }
  host.dropPreview();
  next_ = snap(host, event);
  if (!next_ || !mouth_) return;
  showEdit(host, drawDart(host.document(), mouth_->curve, next_->point, mouth_->fraction,
                          nextCurve(host, CurveKind::Dart)));
}

void DartTool::press(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  if (!first_) {
    mouth_ = pickLine(host, event.at, kLineCatch);
    if (!mouth_) return host.tell(Words::tr("A dart opens on a line: click on a seam or edge."));
    first_ = Snapped{mouth_->point, mouth_->place, host.screen().towardsEye(mouth_->place),
                     std::nullopt, mouth_->curve};
    return;
  }
  next_ = snap(host, event);
  if (!next_) return;
  const NewCurve curve = nextCurve(host, CurveKind::Dart);
  first_.reset();
  keepEdit(host, Words::tr("Dart, %1").arg(QString::fromStdString(curve.name)),
           drawDart(host.document(), mouth_->curve, next_->point, mouth_->fraction, curve));
}

QString DartTool::hint(const ToolHost&) const {
  return first_ ? Words::tr("<b>Dart:</b> click the tip · <Esc> cancel")
                : Words::tr("<b>Dart:</b> click where it opens, on a seam or edge");
}

// ---- split, trim, join

void SplitTool::move(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  next_.reset();
  if (!pick) return;
  next_ = Snapped{pick->point, pick->place, Vector3d::Zero(),
                  SnapMark{SnapMark::Kind::Crossing, pick->place,
                           Words::tr("split %1").arg(titleOf(host, pick->curve))},
                  pick->curve};
}

void SplitTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick || refuseLocked(host, pick->curve)) return;
  const std::vector<double> at{pick->fraction};
  const QString step = Words::tr("Split %1").arg(titleOf(host, pick->curve));
  const Result<Edited> made = splitCurve(host.document(), pick->curve, at);
  if (!made) return host.tell(QString::fromStdString(made.error().message));
  host.commit(step, made->document);
}

QString SplitTool::hint(const ToolHost&) const {
  return Words::tr("<b>Split:</b> click the place on the line");
}

void TrimTool::move(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  const auto pick = pickLine(host, event.at, kLineCatch);
  next_.reset();
  if (!pick) return;
  const Result<Edited> made =
      trimAtCrossings(host.document(), pick->curve, pick->fraction, othersThan(host, pick->curve));
  if (made) host.preview(made->document, /*withPattern=*/false);
}

void TrimTool::press(const PointerEvent& event, ToolHost& host) {
  host.dropPreview();
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick || refuseLocked(host, pick->curve)) return;
  const QString step = Words::tr("Trim %1").arg(titleOf(host, pick->curve));
  const Result<Edited> made =
      trimAtCrossings(host.document(), pick->curve, pick->fraction, othersThan(host, pick->curve));
  if (!made) return host.tell(QString::fromStdString(made.error().message));
  host.commit(step, made->document);
}

QString TrimTool::hint(const ToolHost&) const {
  return Words::tr("<b>Trim:</b> point at a stretch between two crossings, click to remove it");
}

void JoinTool::move(const PointerEvent& event, ToolHost& host) {
  next_ = snap(host, event);
}

void JoinTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick || refuseLocked(host, pick->curve)) return;
  if (line_.empty()) {
    line_ = pick->curve;
    first_ = Snapped{pick->point, pick->place, host.screen().towardsEye(pick->place), std::nullopt,
                     pick->curve};
    return;
  }
  const std::string line = std::exchange(line_, {});
  first_.reset();
  const QString step = Words::tr("Join %1").arg(titleOf(host, line));
  keepEdit(host, step,
           line == pick->curve ? closeCurve(host.document(), line)
                               : joinCurves(host.document(), line, pick->curve));
}

bool JoinTool::key(ToolKey key, ToolHost& host) {
  if (key == ToolKey::Escape) line_.clear();
  return ClickTool::key(key, host);
}

QString JoinTool::hint(const ToolHost&) const {
  return line_.empty() ? Words::tr("<b>Join:</b> click the first end, then the second")
                       : Words::tr("<b>Join:</b> click the second end · <Esc> cancel");
}

}  // namespace toile::studio
