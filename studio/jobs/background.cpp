// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/background.h"

#include <exception>

namespace toile::studio {

class Background::Job final : public Progress {
 public:
  void step(std::string_view) override {}
  [[nodiscard]] bool isCancelled() const override { return cancelled_; }
  void cancel() { cancelled_ = true; }

 private:
  std::atomic<bool> cancelled_ = false;
};

Background::Background(QObject* parent) : QObject(parent) {
  pool_.setMaxThreadCount(1);
}

Background::~Background() {
  stop();
  pool_.waitForDone();
}

void Background::stop() {
  if (job_) job_->cancel();
  job_.reset();
}

void Background::begin(std::function<Outcome(Progress&)> work) {
  stop();
  job_ = std::make_shared<Job>();
  pool_.start([this, job = job_, work = std::move(work)] {
    Outcome outcome;
    try {
      if (!job->isCancelled()) outcome = work(*job);
    } catch (const std::exception&) {
      outcome = nullptr;
    }
    QMetaObject::invokeMethod(
        this,
        [this, job, outcome = std::move(outcome)] {
          if (job_ != job) return;  // another one was begun, or it was stopped
          job_.reset();
          if (outcome) outcome();
        },
        Qt::QueuedConnection);
  });
}

}  // namespace toile::studio
