// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

class QLabel;
class QPushButton;

namespace toile::studio {

class Session;

/// Three steps on the built-in body, told in the corner of its pane; each goes on when it is done,
/// and all can be left at any time.
class Tour final : public QFrame {
  Q_OBJECT
 public:
  Tour(Session& session, QWidget& pane);
  [[nodiscard]] int step() const { return step_; }  ///< from 0; 3: done

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void look();
  void tell();
  void place();

  Session& session_;
  QWidget& pane_;
  QLabel* words_;
  QPushButton* close_;
  int step_ = 0;
  std::size_t curvesBefore_ = 0, stepsBefore_ = 0;
};

}  // namespace toile::studio
