// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/select_tool.h"

#include <Eigen/Geometry>
#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "toile/edit/lines.h"
#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kDragStart = 3;   // px before a press becomes a drag
constexpr double kSlowness = 0.2;  // of the pointer's way, with Shift
constexpr double kNudge = 1;       // mm

struct Words {
  Q_DECLARE_TR_FUNCTIONS(SelectTool)
};

Vector3d normalAt(const Mesh& mesh, const SurfacePoint& point) {
  Vector3d normal = Vector3d::Zero();
  for (const FaceId face : facesOf(mesh, point)) normal += mesh.normal(face);
  return normal.normalized();
}

/// The line, its twin, its original: what a moved point must not be caught by.
std::vector<std::string> family(const PlacedLines& lines, const std::string& id) {
  std::vector<std::string> ids{id};
  for (const auto& line : lines.all()) {
    if (line->curve.mirrorOf == id) ids.push_back(line->curve.id);
    if (line->curve.id == id && line->curve.mirrorOf) ids.push_back(*line->curve.mirrorOf);
  }
  return ids;
}

}  // namespace

const std::vector<Handle>& SelectTool::handles(const ToolHost& host) const {
  const Selection& selected = host.selection();
  const PlacedLine* line =
      selected.kind == Selection::Kind::Line ? host.lines().find(selected.id) : nullptr;
  if (line == nullptr || isLocked(host, selected.id)) {
    handlesCurve_.clear();
    handles_.clear();
  } else if (handlesCurve_ != selected.id || handlesVersion_ != line->version) {
    handlesCurve_ = selected.id;
    handlesVersion_ = line->version;
    Result<std::vector<Handle>> found = handlesOf(host.lines().document(), selected.id);
    handles_ = found ? std::move(*found) : std::vector<Handle>();
  }
  return handles_;
}

std::optional<std::size_t> SelectTool::handleAt(const PointerEvent& event,
                                                const ToolHost& host) const {
  std::optional<std::size_t> best;
  double nearest = event.catchRadius();
  const Mesh& mesh = *host.document().model->mesh;
  const std::vector<Handle>& all = handles(host);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vector3d place = position(mesh, all[i].point);
    const auto pixel = host.screen().toPixel(place);
    if (!pixel || (*pixel - event.at).norm() > nearest) continue;
    if (!isVisible(host, place, normalAt(mesh, all[i].point))) continue;
    nearest = (*pixel - event.at).norm();
    best = i;
  }
  return best;
}

void SelectTool::press(const PointerEvent& event, ToolHost& host) {
  if (const auto handle = handleAt(event, host)) {
    beginDrag(*handle, event, host);
    return;
  }
  if (const auto line = pickLine(host, event.at, kLineCatch)) {
    host.select(Selection::line(line->curve));
    return;
  }
  const auto hit = hitBody(host, event.at);
  const auto piece = hit ? host.pieceAt(hit->point) : std::nullopt;
  host.select(piece ? Selection::piece(*piece) : Selection());
}

bool SelectTool::beginDrag(std::size_t handle, const PointerEvent& event, ToolHost& host) {
  const std::string curve = host.selection().id;
  const Vector3d start = position(*host.document().model->mesh, handles(host)[handle].point);
  Selection selection = host.selection();
  selection.handle = handle;
  host.select(selection);
  Result<CurveDrag> gesture = CurveDrag::begin(host.document(), curve, {}, handle);
  if (!gesture) {
    host.tell(QString::fromStdString(gesture.error().message));
    return false;
  }
  const PlacedLine* line = host.lines().find(curve);
  const Vector2d pixel = host.screen().toPixel(start).value_or(event.at);
  drag_.emplace(Drag{std::move(*gesture), curve, handle, event.at - pixel, event.at, event.at,
                     false, false, start, line->points, line->normals, std::nullopt});
  return true;
}

void SelectTool::move(const PointerEvent& event, ToolHost& host) {
  if (drag_) {
    if (drag_->moved || (event.at - drag_->pressed).norm() >= kDragStart) drag(event, host);
    return;
  }
  overPoint_ = handleAt(event, host).has_value();
  hover_ = {};
  if (overPoint_) return;
  if (const auto line = pickLine(host, event.at, kLineCatch)) {
    hover_ = Selection::line(line->curve);
  } else if (const auto hit = hitBody(host, event.at)) {
    if (const auto piece = host.pieceAt(hit->point)) hover_ = Selection::piece(*piece);
  }
}

void SelectTool::drag(const PointerEvent& event, ToolHost& host) {
  Drag& drag = *drag_;
  drag.moved = true;
  if (event.shift != drag.slow) {
    drag.slow = event.shift;
    drag.slowFrom = event.at;
  }
  PointerEvent aim = event;
  if (drag.slow) aim.at = drag.slowFrom + kSlowness * (event.at - drag.slowFrom);
  aim.at -= drag.grabbed;

  Result<void> moved = drag.gesture.moveUnder(host.screen().rayAt(aim.at));
  drag.mark.reset();
  const Mesh& mesh = *host.document().model->mesh;
  if (moved) {
    const Vector3d here = position(mesh, drag.gesture.handle());
    const auto caught = snap(host, aim, family(host.lines(), drag.curve));
    const double reach = 3 * event.catchRadius() * host.screen().mmPerPixelAt(here);
    // Only what lies on the same part: never what stands before it.
    if (caught && caught->mark && (caught->place - here).norm() <= reach) {
      if (drag.gesture.moveOnto(caught->point)) drag.mark = caught->mark;
    }
  }
  if (const Result<Document> now = drag.gesture.document(); moved && now) {
    host.preview(*now, /*withPattern=*/true);
  } else if (!moved) {
    host.tell(QString::fromStdString(moved.error().message));
  }
}

void SelectTool::release(const PointerEvent&, ToolHost& host) {
  if (!drag_) return;
  const bool moved = drag_->moved;
  const Result<Document> now = drag_->gesture.document();
  const std::string curve = drag_->curve;
  drag_.reset();
  if (!moved) return;
  if (!now) {
    host.dropPreview();
    host.tell(QString::fromStdString(now.error().message));
    return;
  }
  const PlacedLine* line = host.lines().find(curve);
  host.commit(Words::tr("Move point, %1").arg(QString::fromStdString(line->title())), *now);
}

void SelectTool::doubleClick(const PointerEvent& event, ToolHost& host) {
  drag_.reset();
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick || handleAt(event, host)) return;
  const Result<Document> made = insertControl(host.document(), pick->curve, pick->fraction);
  if (!made) return host.tell(QString::fromStdString(made.error().message));
  const QString title = QString::fromStdString(host.lines().find(pick->curve)->title());
  host.commit(Words::tr("Add point, %1").arg(title), *made);
}

bool SelectTool::key(ToolKey key, ToolHost& host) {
  const std::size_t count = handles(host).size();
  Selection selection = host.selection();
  switch (key) {
    case ToolKey::Escape:
      if (drag_) {
        drag_.reset();
        host.dropPreview();
      } else if (selection.handle) {
        selection.handle.reset();
        host.select(selection);
      } else if (selection.kind != Selection::Kind::None) {
        host.select({});
      } else {
        return false;
      }
      return true;
    case ToolKey::Delete:
    case ToolKey::Backspace:
      if (selection.kind != Selection::Kind::Line || drag_) return false;
      remove(host);
      return true;
    case ToolKey::Next:
    case ToolKey::Previous:
      if (count == 0) return false;
      if (!selection.handle) {
        selection.handle = key == ToolKey::Next ? 0 : count - 1;
      } else {
        selection.handle = (*selection.handle + (key == ToolKey::Next ? 1 : count - 1)) % count;
      }
      host.select(selection);
      return true;
    case ToolKey::Left:
    case ToolKey::Right:
    case ToolKey::Up:
    case ToolKey::Down: {
      if (!selection.handle || *selection.handle >= count || drag_) return false;
      const double x = key == ToolKey::Left ? -1 : key == ToolKey::Right ? 1 : 0;
      const double y = key == ToolKey::Up ? -1 : key == ToolKey::Down ? 1 : 0;
      nudge({x, y}, host);
      return true;
    }
    case ToolKey::Enter:
      return false;
  }
  return false;
}

void SelectTool::nudge(const Vector2d& pixels, ToolHost& host) {
  const Selection& selection = host.selection();
  const PlacedLine* line = host.lines().find(selection.id);
  Result<CurveDrag> gesture =
      CurveDrag::begin(host.document(), selection.id, {}, *selection.handle);
  if (!gesture || line == nullptr) return;
  const Mesh& mesh = *host.document().model->mesh;
  const Vector3d from = position(mesh, gesture->handle());
  const auto pixel = host.screen().toPixel(from);
  if (!pixel) return;
  // The direction on the screen, laid onto the surface.
  const Ray a = host.screen().rayAt(*pixel), b = host.screen().rayAt(*pixel + 10 * pixels);
  const double depth = (from - a.origin).norm();
  Vector3d way =
      b.origin + depth * b.direction.normalized() - a.origin - depth * a.direction.normalized();
  const Vector3d normal = normalAt(mesh, gesture->handle());
  way -= way.dot(normal) * normal;
  if (way.norm() < 1e-9) return;
  const Result<void> moved = gesture->moveTo(from + kNudge * way.normalized());
  const Result<Document> now = gesture->document();
  if (!moved || !now) return;
  host.commit(Words::tr("Nudge point, %1").arg(QString::fromStdString(line->title())), *now);
}

void SelectTool::remove(ToolHost& host) {
  const Selection selection = host.selection();
  const PlacedLine* line = host.lines().find(selection.id);
  if (line == nullptr) return;
  if (refuseLocked(host, selection.id)) return;
  const QString title = QString::fromStdString(line->title());
  if (selection.handle && *selection.handle < handles(host).size()) {
    const Handle& handle = handles(host)[*selection.handle];
    const Result<Document> made = removeControl(host.document(), selection.id, handle.at);
    if (!made) return host.tell(QString::fromStdString(made.error().message));
    host.select(Selection::line(selection.id));
    host.commit(Words::tr("Remove point, %1").arg(title), *made);
    return;
  }
  // With its twin; the twin first, since it has no points of its own.
  std::vector<std::string> ids = family(host.lines(), selection.id);
  std::ranges::stable_partition(ids, [&](const std::string& id) {
    return host.lines().find(id) != nullptr && host.lines().find(id)->curve.mirrorOf.has_value();
  });
  Document document = host.document();
  for (const std::string& id : ids) {
    const Result<Document> made = removeCurve(document, id);
    if (!made) return host.tell(QString::fromStdString(made.error().message));
    document = *made;
  }
  host.select({});
  host.commit(Words::tr("Delete %1").arg(title), document);
}

void SelectTool::leave(ToolHost& host) {
  hover_ = {};
  overPoint_ = false;
  if (!drag_) return;
  drag_.reset();
  host.dropPreview();
}

QString SelectTool::hint(const ToolHost&) const {
  if (drag_) {
    return Words::tr(
        "<b>Move point:</b> the line stays on its part of the body · hold <Shift> to move it "
        "slowly "
        "· hold <Ctrl> to ignore snapping · <Esc> puts it back");
  }
  return Words::tr("<b>Select:</b> click a line, a piece or a point · drag to move a point");
}

Overlay SelectTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.hover = hover_;
  const Mesh& mesh = *host.document().model->mesh;
  const std::vector<Handle>& all = handles(host);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool isActive = host.selection().handle == i;
    overlay.points.push_back(
        {position(mesh, all[i].point), normalAt(mesh, all[i].point),
         isActive ? OverlayPoint::Shape::Active : OverlayPoint::Shape::Control});
  }
  if (drag_ && drag_->moved) {
    const SurfacePoint handle = drag_->gesture.handle();
    const Vector3d place = position(mesh, handle);
    overlay.lines.push_back(
        {drag_->before, drag_->normalsBefore, CurveKind::Seam, OverlayLine::Style::Before});
    overlay.snap = drag_->mark;
    overlay.readOut.push_back({Words::tr("moved"), host.lengthText((place - drag_->start).norm())});
    if (const PlacedLine* line = host.lines().find(drag_->curve)) {
      overlay.readOut.push_back({Words::tr("line"), host.lengthText(line->length())});
    }
    if (!isVisible(host, place, normalAt(mesh, handle))) overlay.seeThroughTo = place;
  }
  return overlay;
}

CursorShape SelectTool::cursor() const {
  if (drag_) return CursorShape::ClosedHand;
  return overPoint_ ? CursorShape::OpenHand : CursorShape::Arrow;
}

}  // namespace toile::studio
