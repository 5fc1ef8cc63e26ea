// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/pattern_worker.h"

#include <atomic>
#include <chrono>
#include <exception>

#include "toile/cut/records.h"

namespace toile::studio {

class PatternWorker::Job final : public Progress {
 public:
  explicit Job(bool preview) : isPreview(preview) {}
  void step(std::string_view name) override {
    const std::lock_guard lock(mutex_);
    step_ = name;
  }
  [[nodiscard]] bool isCancelled() const override { return cancelled_; }
  void cancel() { cancelled_ = true; }
  std::string stepName() const {
    const std::lock_guard lock(mutex_);
    return step_;
  }
  const bool isPreview;

 private:
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  std::string step_;
};

PatternWorker::PatternWorker(QObject* parent) : QObject(parent), thread_([this] { run(); }) {}

PatternWorker::~PatternWorker() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    if (running_) running_->cancel();
  }
  wake_.notify_one();
  thread_.join();
}

std::uint64_t PatternWorker::ask(const Document& document, AskedFor what) {
  std::uint64_t request = 0;
  {
    const std::lock_guard lock(mutex_);
    request = ++lastRequest_;
    waiting_ = Question{request, what, document};
    if (running_ && !running_->isPreview) running_->cancel();
  }
  wake_.notify_one();
  Q_EMIT workingChanged();
  return request;
}

bool PatternWorker::isWorking() const {
  const std::lock_guard lock(mutex_);
  return waiting_ || running_;
}

std::string PatternWorker::step() const {
  const std::lock_guard lock(mutex_);
  return running_ ? running_->stepName() : std::string();
}

void PatternWorker::cancel() {
  const std::lock_guard lock(mutex_);
  waiting_.reset();
  if (running_) running_->cancel();
}

void PatternWorker::run() {
  for (;;) {
    Question question;
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || waiting_; });
      if (stopping_) return;
      question = std::move(*waiting_);
      waiting_.reset();
      job = running_ = std::make_shared<Job>(question.what == AskedFor::Preview);
    }
    PatternAnswer result = answerOf(question, *job);
    {
      const std::lock_guard lock(mutex_);
      running_.reset();
      if (stopping_) return;
    }
    QMetaObject::invokeMethod(
        this, [this, result = std::move(result)]() mutable { deliver(std::move(result)); },
        Qt::QueuedConnection);
  }
}

PatternAnswer PatternWorker::answerOf(const Question& question, Progress& progress) {
  const auto begun = std::chrono::steady_clock::now();
  PatternAnswer result;
  result.request = question.request;
  result.isPreview = question.what == AskedFor::Preview;
  result.document = question.document;
  try {
    Result<LiveAnswer> made = live_.update(
        question.document, result.isPreview ? Quality::Preview : Quality::Full, &progress);
    if (made) {
      result.pattern = std::make_shared<const Pattern>(std::move(made->pattern));
      if (!result.isPreview) {
        const bool sameModel = lastFull_ && lastFull_->document.model == question.document.model;
        if (question.what == AskedFor::Step && sameModel &&
            lastFull_->document.design != question.document.design) {
          Result<Design> followed =
              followRecords(*lastFull_->document.design, lastFull_->cut, *question.document.design,
                            result.pattern->cut, *question.document.model);
          if (followed && !(*followed == *question.document.design)) {
            result.followed = std::make_shared<const Design>(std::move(*followed));
          }
        }
        lastFull_ = result.pattern;
        result.strains = std::make_shared<const std::vector<std::optional<PieceStrain>>>(
            measureStrains(*result.pattern));
      }
    } else {
      result.error = made.error();
    }
  } catch (const std::exception& fault) {
    result.error = Error{ErrorCode::NotConverged, fault.what(), {}};
  }
  result.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

void PatternWorker::deliver(PatternAnswer result) {
  const bool isCancelled = result.error && result.error->code == ErrorCode::Cancelled;
  bool isCurrent = false;
  {
    const std::lock_guard lock(mutex_);
    // A preview of a moment ago is better than none; a full answer must be the last asked for.
    isCurrent = result.isPreview ? result.request > answeredFully_ : result.request == lastRequest_;
    if (isCurrent && !result.isPreview) answeredFully_ = result.request;
  }
  if (isCurrent && !isCancelled) Q_EMIT answered(result);
  Q_EMIT workingChanged();
}

}  // namespace toile::studio
