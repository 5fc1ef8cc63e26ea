// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/fair_tool.h"

#include <Eigen/Geometry>
#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "toile/edit/measure.h"
#include "tools/drawing.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

constexpr double kFinest = 10;        // mm: the ripples that go at strength 0
constexpr double kPixelsOfAll = 400;  // of drag from the least strength to the greatest
constexpr double kTooth = 25;         // mm of the longest tooth of the line as it is
constexpr double kToothSpacing = 8;   // mm along the line
constexpr std::size_t kMostTeeth = 160;

struct Words {
  Q_DECLARE_TR_FUNCTIONS(FairTool)
};

/// Ripples shorter than this go; the whole line at strength 1.
double wavelengthOf(double strength, double length) {
  return kFinest * std::pow(std::max(2.0, length / kFinest), strength);
}

double strengthOf(double wavelength, double length) {
  const double range = std::log(std::max(2.0, length / kFinest));
  return std::clamp(std::log(std::max(1.0, wavelength / kFinest)) / range, 0.0, 1.0);
}

std::vector<CurvatureSample> bendsOf(const Document& document, const std::string& curve,
                                     double length) {
  const auto count = static_cast<std::size_t>(std::max(3.0, length / kToothSpacing));
  Result<std::vector<CurvatureSample>> samples =
      curvatureOf(document, curve, std::min(count, kMostTeeth));
  return samples ? std::move(*samples) : std::vector<CurvatureSample>();
}

/// The comb: teeth square to the line, and the line through their tips.
std::vector<OverlayLine> combOf(const std::vector<CurvatureSample>& samples, double scale,
                                bool isBefore) {
  std::vector<OverlayLine> comb;
  OverlayLine tips;
  tips.style = isBefore ? OverlayLine::Style::Before : OverlayLine::Style::Comb;
  for (const CurvatureSample& sample : samples) {
    const Vector3d side = sample.normal.cross(sample.tangent);
    // On the outside of the bend, where combs are looked for.
    const Vector3d tip = sample.position - scale * sample.curvature * side;
    tips.points.push_back(tip);
    if (!isBefore) {
      comb.push_back({{sample.position, tip}, {}, CurveKind::Guide, OverlayLine::Style::Comb});
    }
  }
  comb.push_back(std::move(tips));
  return comb;
}

}  // namespace

void FairTool::take(const std::string& curve, ToolHost& host) {
  cancel(host);
  const PlacedLine* line = host.lines().find(curve);
  if (line == nullptr || refuseLocked(host, curve)) return;
  curve_ = curve;
  length_ = line->length();
  host.select(Selection::line(curve));
  const std::vector<CurvatureSample> bends = bendsOf(host.document(), curve, length_);
  double most = 1e-6;
  for (const CurvatureSample& sample : bends) most = std::max(most, std::abs(sample.curvature));
  combScale_ = std::min(kTooth, 0.2 * length_) / most;
  combBefore_ = combOf(bends, combScale_, /*isBefore=*/true);
  const Result<FairedDocument> made = fairCurves(host.document(), std::vector{curve});
  if (made && !made->curves.empty()) {
    strength_ = strengthOf(made->curves.front().wavelength.mm(), length_);
  }
  show(host);
}

void FairTool::show(ToolHost& host) {
  FairCurvesOptions options;
  options.fairing.wavelength = Length::mm(wavelengthOf(strength_, length_));
  const Result<FairedDocument> made = fairCurves(host.document(), std::vector{curve_}, options);
  if (!made) {
    faired_.reset();
    combAfter_.clear();
    host.dropPreview();
    return host.tell(QString::fromStdString(made.error().message));
  }
  faired_ = made->document;
  figures_ = made->curves.empty() ? FairedCurve() : made->curves.front();
  host.preview(*faired_, /*withPattern=*/true);
  const PlacedLine* line = host.lines().find(curve_);
  combAfter_ = combOf(bendsOf(*faired_, curve_, line == nullptr ? length_ : line->length()),
                      combScale_, /*isBefore=*/false);
}

void FairTool::cancel(ToolHost& host) {
  curve_.clear();
  faired_.reset();
  combBefore_.clear();
  combAfter_.clear();
  dragging_ = false;
  host.dropPreview();
}

void FairTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (pick && pick->curve != curve_) take(pick->curve, host);
  if (curve_.empty()) return;
  dragging_ = true;
  pressedAt_ = event.at.x();
  strengthAtPress_ = strength_;
}

void FairTool::move(const PointerEvent& event, ToolHost& host) {
  if (!dragging_) {
    const auto pick = pickLine(host, event.at, kLineCatch);
    hover_ = pick ? Selection::line(pick->curve) : Selection();
    return;
  }
  const double strength =
      std::clamp(strengthAtPress_ + (event.at.x() - pressedAt_) / kPixelsOfAll, 0.0, 1.0);
  if (std::abs(strength - strength_) < 0.005) return;
  strength_ = strength;
  show(host);
}

void FairTool::release(const PointerEvent&, ToolHost&) {
  dragging_ = false;
}

std::optional<ToolSetting> FairTool::setting() const {
  return ToolSetting{Words::tr("Strength"), ToolSetting::Kind::Share, strength_};
}

void FairTool::set(double value, ToolHost& host) {
  strength_ = std::clamp(value, 0.0, 1.0);
  if (curve_.empty() && host.selection().kind == Selection::Kind::Line) {
    const double wanted = strength_;
    take(host.selection().id, host);
    strength_ = wanted;
  }
  if (!curve_.empty()) show(host);
}

bool FairTool::key(ToolKey key, ToolHost& host) {
  if (curve_.empty()) return false;
  if (key == ToolKey::Escape) {
    cancel(host);
    return true;
  }
  if (key != ToolKey::Enter || !faired_) return false;
  const Document document = *faired_;
  const QString step = Words::tr("Fair %1").arg(titleOf(host, curve_));
  cancel(host);
  host.commit(step, document);
  return true;
}

void FairTool::leave(ToolHost& host) {
  hover_ = {};
  cancel(host);
}

QString FairTool::hint(const ToolHost&) const {
  return curve_.empty() ? Words::tr("<b>Fair:</b> click the line that shall be calmer")
                        : Words::tr(
                              "<b>Fair:</b> drag right for calmer, left for closer to the "
                              "drawing · <Enter> keep · <Esc> cancel");
}

Overlay FairTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  if (!dragging_) overlay.hover = hover_;
  if (curve_.empty()) return overlay;
  for (const auto* comb : {&combBefore_, &combAfter_}) {
    overlay.lines.insert(overlay.lines.end(), comb->begin(), comb->end());
  }
  if (!faired_) return overlay;
  overlay.readOut.push_back(
      {Words::tr("calmer"), QStringLiteral("%1 %").arg(std::lround(100 * strength_))});
  overlay.readOut.push_back({Words::tr("moved up to"), host.lengthText(figures_.deviation.mm())});
  overlay.readOut.push_back({Words::tr("bends"), QStringLiteral("%1 → %2")
                                                     .arg(figures_.inflectionsBefore + 1)
                                                     .arg(figures_.inflectionsAfter + 1)});
  if (const PlacedLine* line = host.lines().find(curve_)) {
    overlay.readOut.push_back({Words::tr("line"), host.lengthText(line->length())});
  }
  return overlay;
}

}  // namespace toile::studio
