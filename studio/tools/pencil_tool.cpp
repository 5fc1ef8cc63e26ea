// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pencil_tool.h"

#include <QCoreApplication>
#include <algorithm>

#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

/// Of the height of the view: what a hand trembles by. The engine's own measure, see PencilOptions.
constexpr double kTolerance = 1.0 / 400;
/// In catch radii: how near to a caught end a stroke is straightened.
constexpr double kCatchWidth = 1.2;
/// A stroke shorter than this, px, was a click.
constexpr double kShortest = 8;

struct Words {
  Q_DECLARE_TR_FUNCTIONS(PencilTool)
};

}  // namespace

void PencilTool::press(const PointerEvent& event, ToolHost& host) {
  samples_.clear();
  end_.reset();
  start_ = snap(host, event);
  if (start_ && !start_->mark) start_.reset();
  drawing_ = true;
  PointerEvent first = event;
  if (start_) first.at = host.screen().toPixel(start_->place).value_or(event.at);
  add(first, host);
}

void PencilTool::add(const PointerEvent& event, ToolHost& host) {
  Sample sample{event, std::nullopt, Vector3d::Zero()};
  if (const auto hit = hitBody(host, event.at)) {
    sample.place = hit->position;
    sample.normal = host.screen().towardsEye(hit->position);
  }
  samples_.push_back(sample);
}

void PencilTool::move(const PointerEvent& event, ToolHost& host) {
  hover_ = snap(host, event);
  if (!drawing_) return;
  if (samples_.size() < kMaxStrokeSamples) add(event, host);
  end_ = hover_ && hover_->mark ? hover_ : std::nullopt;
}

void PencilTool::release(const PointerEvent& event, ToolHost& host) {
  if (!drawing_) return;
  move(event, host);
  drawing_ = false;
  double reach = 0;
  for (const Sample& sample : samples_) {
    reach = std::max(reach, (sample.event.at - samples_.front().event.at).norm());
  }
  if (reach >= kShortest) finish(host);
  samples_.clear();
}

void PencilTool::finish(ToolHost& host) {
  // Where an end is caught, what the hand drew beside that place would become a hook.
  const auto isBeside = [&](const std::optional<Snapped>& caught) {
    const auto at = host.screen().toPixel(caught->place);
    return [at](const Sample& sample) {
      return at && (sample.event.at - *at).norm() < kCatchWidth * sample.event.catchRadius();
    };
  };
  if (start_) {
    const auto last = std::find_if_not(samples_.begin() + 1, samples_.end(), isBeside(start_));
    samples_.erase(samples_.begin() + 1, last);
  }
  if (end_) {
    Sample last = samples_.back();
    while (samples_.size() > 1 && isBeside(end_)(samples_.back())) samples_.pop_back();
    last.event.at = host.screen().toPixel(end_->place).value_or(last.event.at);
    samples_.push_back(last);
  }
  std::vector<StrokeSample> stroke;
  for (const Sample& sample : samples_) {
    stroke.push_back(
        {host.screen().toPlane(sample.event.at), sample.event.seconds, sample.event.pressure});
  }
  PencilOptions options;
  options.tolerance = Length::mm(kTolerance * host.options().smoothing * host.screen().view.height);
  if (start_ || end_) options.closed = false;
  Result<Edited> drawn =
      drawStroke(host.document(), host.screen().view, stroke, nextCurve(host), options);
  if (!drawn) return host.tell(QString::fromStdString(drawn.error().message));
  if (drawn->curves.empty()) return;
  if (start_) {
    drawn->document = withEndAt(drawn->document, drawn->curves.front(), true, start_->point);
  }
  if (end_) drawn->document = withEndAt(drawn->document, drawn->curves.back(), false, end_->point);
  for (const Finding& finding : drawn->findings) host.tell(QString::fromStdString(finding.message));

  const Document document = withTwins(host, *drawn);
  host.commit(Words::tr("Pencil, %1").arg(QString::fromStdString(nextCurve(host).name)), document);
  host.select(Selection::line(drawn->curves.front()));
}

bool PencilTool::key(ToolKey key, ToolHost&) {
  if (key != ToolKey::Escape || !drawing_) return false;
  drawing_ = false;
  samples_.clear();
  return true;
}

void PencilTool::leave(ToolHost&) {
  drawing_ = false;
  samples_.clear();
  hover_.reset();
}

QString PencilTool::hint(const ToolHost&) const {
  if (!drawing_) return Words::tr("<b>Pencil:</b> draw on the body");
  if (!samples_.empty() && !samples_.back().place) {
    return Words::tr(
        "<b>Pencil:</b> The stroke left the body. It ends at the edge; draw on to continue it.");
  }
  return Words::tr("<b>Pencil:</b> lift to finish · <Esc> throws the stroke away");
}

Overlay PencilTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.showMiddle = host.options().symmetry;
  if (hover_) overlay.snap = hover_->mark;
  // The stroke as it is drawn, parted where it leaves the body.
  OverlayLine line;
  line.kind = host.options().kind;
  const auto end = [&] {
    if (line.points.size() > 1) overlay.lines.push_back(line);
    line.points.clear();
    line.normals.clear();
  };
  for (const Sample& sample : samples_) {
    if (!sample.place) {
      end();
      continue;
    }
    line.points.push_back(*sample.place);
    line.normals.push_back(sample.normal);
  }
  end();
  return overlay;
}

}  // namespace toile::studio
