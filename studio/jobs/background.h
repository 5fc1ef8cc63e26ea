// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <functional>
#include <memory>

#include "toile/core/progress.h"

namespace toile::studio {

/// Work beside the window of which only the newest counts: beginning another stops what runs, and
/// what that came to is dropped. The window and all that is in it stay alive meanwhile.
class Background final : public QObject {
  Q_OBJECT
 public:
  explicit Background(QObject* parent = nullptr);
  ~Background() override;  ///< stops the work and waits for it

  using Outcome = std::function<void()>;
  /// @param work off the UI thread; gives what is to be done with its result on the UI thread.
  /// What it throws counts as no result.
  void begin(std::function<Outcome(Progress&)> work);
  void stop();
  [[nodiscard]] bool isWorking() const { return job_ != nullptr; }

 private:
  class Job;
  std::shared_ptr<Job> job_;
  QThreadPool pool_;
};

}  // namespace toile::studio
