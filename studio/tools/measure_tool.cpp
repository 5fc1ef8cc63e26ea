// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/measure_tool.h"

#include <QCoreApplication>
#include <cmath>
#include <limits>

#include "toile/curve/geodesic.h"
#include "toile/edit/measure.h"
#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(MeasureTool)
};

std::vector<Vector3d> pointsOf(const Mesh& mesh, const SurfacePath& path) {
  std::vector<Vector3d> points;
  for (const SurfacePoint& point : path.points) points.push_back(position(mesh, point));
  if (path.closed && !points.empty()) points.push_back(points.front());
  return points;
}

double lengthOf(const std::vector<Vector3d>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// The loop of the section that passes a place.
std::vector<Vector3d> loopThrough(const ReferenceModel& model, const Vector3d& place,
                                  const Vector3d& normal) {
  std::vector<Vector3d> best;
  double nearest = std::numeric_limits<double>::max();
  for (const SurfacePath& path : model.index->planeSection(normal, normal.dot(place))) {
    const std::vector<Vector3d> points = pointsOf(*model.mesh, path);
    for (const Vector3d& point : points) {
      const double distance = (point - place).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      best = points;
    }
  }
  return best;
}

}  // namespace

std::optional<MeasureTool::Way> MeasureTool::wayTo(const Snapped& place,
                                                   const ToolHost& host) const {
  const ReferenceModel& model = *host.document().model;
  if (!first_ || first_->point == place.point) return std::nullopt;
  GeodesicLinker linker(model.mesh);
  const Result<SurfacePath> path = linker.link(first_->point, place.point);
  if (!path) return std::nullopt;
  Way way{pointsOf(*model.mesh, *path), 0, (place.place - first_->place).norm()};
  way.onSurface = lengthOf(way.points);
  return way;
}

/// What lies below the pointer tells its own measure.
void MeasureTool::readAround(const PointerEvent& event, const ToolHost& host) {
  around_.clear();
  girth_.clear();
  hover_ = {};
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (pick) {
    hover_ = Selection::line(pick->curve);
    const PlacedLine* line = host.lines().find(pick->curve);
    around_.push_back({titleOf(host, pick->curve), host.lengthText(line->length())});
    if (!line->path.closed) {
      around_.push_back(
          {Words::tr("from its start"), host.lengthText(pick->fraction * line->length())});
    }
    const auto other = pickLine(host, event.at, kLineCatch, {pick->curve});
    if (!other) return;
    const auto meetings = meetingsOf(host.document(), pick->curve, other->curve);
    if (!meetings) return;
    const CurveMeeting* at = nullptr;
    double nearest = 2 * kLineCatch;
    for (const CurveMeeting& meeting : *meetings) {
      const Vector3d place = position(*host.document().model->mesh, meeting.point);
      const auto pixel = host.screen().toPixel(place);
      if (!pixel || (*pixel - event.at).norm() >= nearest) continue;
      nearest = (*pixel - event.at).norm();
      at = &meeting;
    }
    if (at != nullptr) {
      around_.push_back({Words::tr("angle with %1").arg(titleOf(host, other->curve)),
                         QStringLiteral("%1°").arg(at->angle.degrees(), 0, 'f', 1)});
    }
    return;
  }
  if (!next_ || first_) return;
  const Vector3d normal = event.shift ? host.screen().view.up : Vector3d(0, 0, 1);
  girth_ = loopThrough(*host.document().model, next_->place, normal);
  if (girth_.size() > 2) {
    around_.push_back({Words::tr("girth"), host.lengthText(lengthOf(girth_))});
  }
}

void MeasureTool::move(const PointerEvent& event, ToolHost& host) {
  next_ = snap(host, event);
  if (isDone_) return;
  readAround(event, host);
  way_ = next_ ? wayTo(*next_, host) : std::nullopt;
}

void MeasureTool::press(const PointerEvent& event, ToolHost& host) {
  const auto place = snap(host, event);
  if (!place) return;
  if (!first_ || isDone_) {
    first_ = place;
    way_.reset();
    isDone_ = false;
    girth_.clear();
    return;
  }
  way_ = wayTo(*place, host);
  isDone_ = way_.has_value();
}

bool MeasureTool::key(ToolKey key, ToolHost&) {
  if ((key != ToolKey::Escape && key != ToolKey::Backspace) || !first_) return false;
  if (isDone_ && key == ToolKey::Backspace) {
    isDone_ = false;
    return true;
  }
  first_.reset();
  way_.reset();
  isDone_ = false;
  return true;
}

void MeasureTool::leave(ToolHost&) {
  first_.reset();
  next_.reset();
  way_.reset();
  isDone_ = false;
  around_.clear();
  girth_.clear();
  hover_ = {};
}

QString MeasureTool::hint(const ToolHost&) const {
  if (isDone_)
    return Words::tr(
        "<b>Measure:</b> click to measure anew · <Backspace> take the second place "
        "back · <Esc> end");
  return first_ ? Words::tr("<b>Measure:</b> click the second place · <Esc> cancel")
                : Words::tr(
                      "<b>Measure:</b> click two places on the body or the pattern · lines, "
                      "crossings and girths tell theirs · <Shift> tilts the girth");
}

Overlay MeasureTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.hover = hover_;
  if (next_ && !isDone_) overlay.snap = next_->mark;
  if (first_) {
    overlay.points.push_back({first_->place, first_->normal, OverlayPoint::Shape::Control});
  }
  if (girth_.size() > 2) {
    overlay.lines.push_back({girth_, {}, CurveKind::Guide, OverlayLine::Style::Measure});
  }
  if (!way_) {
    overlay.readOut = around_;
    return overlay;
  }
  overlay.lines.push_back({way_->points, {}, CurveKind::Guide, OverlayLine::Style::Measure});
  const std::vector<ReadOut> rows{{Words::tr("over the surface"), host.lengthText(way_->onSurface)},
                                  {Words::tr("straight"), host.lengthText(way_->straight)}};
  if (!isDone_) {
    overlay.readOut = rows;
    overlay.readOut.insert(overlay.readOut.end(), around_.begin(), around_.end());
  } else {
    overlay.labels.push_back({way_->points[way_->points.size() / 2], rows});
  }
  return overlay;
}

}  // namespace toile::studio
