// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDateTime>
#include <QString>
#include <vector>

#include "toile/design/design.h"

namespace toile::studio {

/// One state of the work and the step that led to it.
struct Step {
  QString name;  ///< "Move point, Back princess"
  QString icon;  ///< of the tool, see app/icons.h
  Document document;
  QDateTime time;
};

/// The states of the work, oldest first; undo without end. Documents share what they have in
/// common, so that a step costs what it changed.
class History {
 public:
  explicit History(Step first) : steps_{std::move(first)} {}

  [[nodiscard]] const Document& current() const { return steps_[at_].document; }
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] bool canUndo() const { return at_ > 0; }
  [[nodiscard]] bool canRedo() const { return at_ + 1 < steps_.size(); }

  /// A new state; what was undone is gone.
  void push(Step step);
  /// The same state put more exactly (records that followed their pieces): no step of its own.
  void amend(Document document) { steps_[at_].document = std::move(document); }
  void jumpTo(std::size_t step) { at_ = std::min(step, steps_.size() - 1); }

 private:
  std::vector<Step> steps_;
  std::size_t at_ = 0;
};

}  // namespace toile::studio
