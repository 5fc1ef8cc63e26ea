// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <string>
#include <vector>

#include "app/session.h"
#include "jobs/background.h"
#include "toile/develop/darts.h"

class QButtonGroup;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace toile::studio {

/// The dart adviser: darts and cuts that would let a piece lie flat better, the best first, each
/// with its size, the sewing that it adds and the strain before and after. The chosen one is drawn
/// in both panes; placing it is one step.
class DartPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit DartPanel(Session& session, QWidget* parent = nullptr);

  void open(const std::string& piece);
  void leave();
  [[nodiscard]] const std::string& piece() const { return piece_; }
  [[nodiscard]] bool isLooking() const { return work_.isWorking(); }
  [[nodiscard]] const std::vector<DartProposal>& proposals() const { return proposals_; }

 Q_SIGNALS:
  void ended();

 private:
  void look();
  void showProposals();
  void choose(std::size_t proposal);
  void place();
  [[nodiscard]] QString reason(std::size_t index) const;

  Session& session_;
  Background work_;
  std::string piece_;
  std::shared_ptr<const Pattern> pattern_;  ///< that was looked at
  std::vector<DartProposal> proposals_;
  std::size_t chosen_ = 0;

  QLabel* why_ = nullptr;
  QLabel* state_ = nullptr;
  QVBoxLayout* cards_ = nullptr;
  QWidget* content_ = nullptr;
  QPushButton* place_ = nullptr;
};

}  // namespace toile::studio
