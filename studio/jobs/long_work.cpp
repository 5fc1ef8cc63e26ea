// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/long_work.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QProgressDialog>
#include <QTimer>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace toile::studio {

namespace {

constexpr int kSilence = 300;  // ms without a box
constexpr int kLook = 15;      // ms between looks at the work

class Told final : public Progress {
 public:
  void step(std::string_view name) override {
    const std::lock_guard lock(mutex_);
    step_ = name;
  }
  [[nodiscard]] bool isCancelled() const override { return cancelled_; }
  void cancel() { cancelled_ = true; }
  QString stepName() const {
    const std::lock_guard lock(mutex_);
    return QString::fromStdString(step_);
  }

 private:
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  std::string step_;
};

/// Of the work that the window waits for.
Told*& running() {
  static Told* work = nullptr;
  return work;
}

}  // namespace

bool isLongWorkRunning() {
  return running() != nullptr;
}

void stopLongWork() {
  if (running() != nullptr) running()->cancel();
}

std::optional<std::string> runLongWork(QWidget* parent, const QString& title,
                                       const std::function<void(Progress&)>& work) {
  Told told;
  Told* const outer = std::exchange(running(), &told);
  std::atomic<bool> ended = false;
  std::optional<std::string> fault;
  std::thread thread([&] {
    try {
      work(told);
    } catch (const std::exception& thrown) {
      fault = thrown.what();
    }
    ended = true;
  });
  QEventLoop loop;
  QElapsedTimer clock;
  clock.start();
  bool isShown = false;
  QTimer look;
  QObject::connect(&look, &QTimer::timeout, &loop, [&] {
    if (ended || (!isShown && clock.elapsed() >= kSilence)) loop.quit();
  });
  look.start(kLook);
  // Short work shows nothing, and nothing can be done meanwhile that it would not expect.
  QApplication::setOverrideCursor(Qt::WaitCursor);
  loop.exec(QEventLoop::ExcludeUserInputEvents);
  QApplication::restoreOverrideCursor();
  if (!ended) {
    isShown = true;
    QProgressDialog box(title, QApplication::translate("LongWork", "Cancel"), 0, 0, parent);
    box.setObjectName(QStringLiteral("longWork"));
    box.setWindowModality(Qt::ApplicationModal);
    box.setMinimumDuration(0);
    box.setMinimumWidth(360);
    QObject::connect(&box, &QProgressDialog::canceled, &box, [&] {
      told.cancel();
      box.setLabelText(QApplication::translate("LongWork", "%1\nStopping…").arg(title));
      box.show();  // until it has stopped
    });
    QObject::connect(&look, &QTimer::timeout, &box, [&] {
      if (!told.isCancelled()) box.setLabelText(title + '\n' + told.stepName());
    });
    box.show();
    loop.exec();
  }
  thread.join();
  running() = outer;
  return fault;
}

}  // namespace toile::studio
