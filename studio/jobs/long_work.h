// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <functional>
#include <optional>

#include "toile/core/progress.h"
#include "toile/core/result.h"

class QWidget;

namespace toile::studio {

/// Does work off the UI thread while the window stays alive: after 0.3 s a box tells the step and
/// offers Cancel. Returns when the work has ended, also after Cancel. What it throws comes as the
/// returned words.
[[nodiscard]] std::optional<std::string> runLongWork(QWidget* parent, const QString& title,
                                                     const std::function<void(Progress&)>& work);

/// Long work is running: the window waits in runLongWork().
[[nodiscard]] bool isLongWorkRunning();
/// Asks it to stop, as Cancel does.
void stopLongWork();

/// The same for a call that gives a Result.
template <class T>
Result<T> longWork(QWidget* parent, const QString& title,
                   const std::function<Result<T>(Progress&)>& work) {
  std::optional<Result<T>> result;
  const auto fault =
      runLongWork(parent, title, [&](Progress& progress) { result.emplace(work(progress)); });
  if (fault) return Error{ErrorCode::NotConverged, *fault, {}};
  return std::move(*result);
}

}  // namespace toile::studio
