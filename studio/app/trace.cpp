// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/trace.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "app/session.h"
#include "pattern/pattern_view.h"
#include "viewport/viewport.h"

namespace toile::studio {

Trace::Trace(Session& session, Viewport& viewport, PatternView& pattern,
             const std::filesystem::path& file)
    : session_(session),
      viewport_(viewport),
      pattern_(pattern),
      file_(QString::fromStdString(file.string())) {
  if (!file_.open(QIODevice::WriteOnly | QIODevice::Text)) return;
  clock_.start();
  viewport.installEventFilter(this);
  pattern.installEventFilter(this);
  connect(&viewport, &Viewport::painted, this, [this] {
    if (redrawSince_) note("drawing", clockNow() - paintedFrom_);
  });
  connect(&session, &Session::linesChanged, this, &Trace::linesChanged);
  connect(&session.worker(), &PatternWorker::answered, this, &Trace::answered);
  connect(&session, &Session::patternChanged, this, &Trace::patternChanged);
}

Trace::~Trace() {
  if (!file_.isOpen()) return;
  for (auto& [kind, waits] : waits_) {
    std::ranges::sort(waits);
    const auto at = [&, &waits = waits](double part) {
      const auto rank = static_cast<std::size_t>(std::ceil(part * double(waits.size())));
      return waits[std::max<std::size_t>(rank, 1) - 1];
    };
    file_.write(QStringLiteral("# %1\t%2\tmedian %3\tp95 %4\tmax %5\n")
                    .arg(QString::fromStdString(kind))
                    .arg(waits.size())
                    .arg(at(0.5), 0, 'f', 1)
                    .arg(at(0.95), 0, 'f', 1)
                    .arg(waits.back(), 0, 'f', 1)
                    .toUtf8());
  }
}

const std::vector<double>& Trace::waits(const char* kind) const {
  static const std::vector<double> kNone;
  const auto found = waits_.find(kind);
  return found == waits_.end() ? kNone : found->second;
}

bool Trace::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Paint) {
    if (watched == &pattern_) patternPainted_ = true;
    if (watched == &viewport_) {
      bodyPainted_ = true;
      paintedFrom_ = clockNow();
    }
    // Widgets that wait for it are painted and given to the window system in one go; then this.
    QMetaObject::invokeMethod(
        this, [this] { shown(); }, Qt::QueuedConnection);
    return false;
  }
  if (watched != &viewport_) return false;
  if (event->type() != QEvent::MouseMove && event->type() != QEvent::MouseButtonPress &&
      event->type() != QEvent::MouseButtonRelease) {
    return false;
  }
  const auto& mouse = static_cast<const QMouseEvent&>(*event);
  // The window system's stamp is on the same clock; events made inside the program have none.
  const double now = clockNow();
  const auto stamp = static_cast<double>(mouse.timestamp());
  handledAt_ = clockNow();
  eventAt_ = stamp > now - 60000 && stamp <= now ? stamp : now;
  isDragging_ = mouse.buttons().testFlag(Qt::LeftButton);
  if (event->type() == QEvent::MouseButtonRelease && session_.isPreview()) {
    releaseSince_ = eventAt_;
    fullCame_ = false;
  }
  return false;
}

void Trace::linesChanged() {
  if (!isDragging_ || !session_.isPreview()) return;
  note("line", clockNow() - handledAt_);
  if (!redrawSince_) redrawSince_ = eventAt_;
  bodyPainted_ = false;
  moves_[session_.shown().design] = eventAt_;
}

void Trace::answered(const PatternAnswer& answer) {
  note(answer.isPreview ? "engine-preview" : "engine-full", answer.milliseconds);
  if (!answer.isPreview) return moves_.clear();
  const auto move = moves_.find(answer.document.design);
  if (move == moves_.end() || !answer.pattern) return;
  previewSince_ = move->second;
  moves_.erase(move);
  // The pane repaints itself before this is told; the next event may be another move.
  if (patternPainted_) shown();
}

void Trace::patternChanged() {
  if (!releaseSince_ || session_.isPatternPreview() || !session_.isPatternCurrent()) return;
  fullCame_ = true;
}

void Trace::shown() {
  if (bodyPainted_ && redrawSince_) {
    write("redraw", *std::exchange(redrawSince_, std::nullopt));
  }
  bodyPainted_ = false;
  if (!std::exchange(patternPainted_, false)) return;
  if (previewSince_) write("preview", *std::exchange(previewSince_, std::nullopt));
  if (fullCame_ && releaseSince_) {
    write("full", *std::exchange(releaseSince_, std::nullopt));
    fullCame_ = false;
  }
}

double Trace::clockNow() const {
  return static_cast<double>(clock_.msecsSinceReference()) +
         static_cast<double>(clock_.nsecsElapsed()) * 1e-6;
}

void Trace::write(const char* kind, double since) {
  note(kind, clockNow() - since);
}

void Trace::note(const char* kind, double waited) {
  waits_[kind].push_back(waited);
  file_.write(QStringLiteral("%1\t%2\t%3\n")
                  .arg(static_cast<double>(clock_.nsecsElapsed()) * 1e-6, 0, 'f', 1)
                  .arg(QString::fromLatin1(kind))
                  .arg(waited, 0, 'f', 1)
                  .toUtf8());
  file_.flush();
}

}  // namespace toile::studio
